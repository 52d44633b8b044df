# SPDX-License-Identifier: Apache-2.0
"""The markers that have come since the last frame."""

from __future__ import annotations

from typing import Any, NamedTuple

from visualization_msgs.msg import Marker

__all__ = ['Coming', 'Inbox', 'Key']

Key = tuple[str, int]
"""The namespace of a marker, and its number in that."""


class Coming(NamedTuple):
    """The newest message on a marker, and when it came in nanoseconds of the node's clock."""

    marker: Any
    came_ns: int


class Inbox:
    """What is to be done with markers; of each only the newest counts, as it replaces others."""

    def __init__(self) -> None:
        self.deletes_all = False
        self.coming: dict[Key, Coming] = {}
        self.refusal = ''

    def put(self, marker: Any, came_ns: int) -> None:
        """
        Queue a marker, in place of an older one with the same namespace and id.

        Parameters
        ----------
        marker
            The message, of the type `visualization_msgs/msg/Marker`. One that deletes all also
            drops those that wait.
        came_ns
            When it came, in ns of the node's clock.

        """
        if marker.action == Marker.DELETEALL:
            self.deletes_all = True
            self.coming = {}
        elif marker.action in (Marker.ADD, Marker.DELETE):  # MODIFY has the number of ADD
            key = marker.ns, marker.id
            self.coming.pop(key, None)
            self.coming[key] = Coming(marker, came_ns)
        else:
            self.refusal = (
                f'The marker {marker.ns}/{marker.id} is left out: its action {marker.action} is '
                'not known.'
            )

    def take_some(self, most: int) -> list[tuple[Key, Coming]]:
        """
        Take the oldest markers out of the queue; the others stay for the next frame.

        Parameters
        ----------
        most
            The largest number of markers to take.

        Returns
        -------
        list[tuple[Key, Coming]]
            The markers to add, change or delete, with their namespaces and ids.

        """
        keys = list(self.coming)[:most]
        return [(key, self.coming.pop(key)) for key in keys]
