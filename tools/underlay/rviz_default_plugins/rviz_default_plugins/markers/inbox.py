# SPDX-License-Identifier: Apache-2.0
"""The queue of the markers that have been received, and are to be drawn."""

from __future__ import annotations

from typing import Any

from rviz_default_plugins.markers.shown_marker import Coming
from visualization_msgs.msg import Marker as MarkerMessage

__all__ = ['Inbox', 'Key']

Key = tuple[str, int]
"""The namespace of a marker, and its id."""


class Inbox:
    """Queue of marker messages; a newer message replaces an older one of the same marker."""

    def __init__(self) -> None:
        self.deletes_all = False
        self.coming: dict[Key, Coming] = {}
        self.refusal = ''

    def put(self, marker: Any, came_ns: int) -> None:
        """
        Queue a marker, replacing an older one with the same namespace and id.

        Parameters
        ----------
        marker
            The message, of the type `visualization_msgs/msg/Marker`. DELETEALL also drops
            the queued ones.
        came_ns
            Its time of reception, in ns of the node's clock.

        """
        if marker.action == MarkerMessage.DELETEALL:
            self.deletes_all = True
            self.coming = {}
        elif marker.action in (
            MarkerMessage.ADD,
            MarkerMessage.DELETE,
        ):  # MODIFY has the same value as ADD
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
        Remove and return the oldest markers in the queue; the rest wait for the next frame.

        Parameters
        ----------
        most
            The maximum number of markers to return.

        Returns
        -------
        list[tuple[Key, Coming]]
            The markers to add, change or delete, with their namespaces and ids.

        """
        keys = list(self.coming)[:most]
        return [(key, self.coming.pop(key)) for key in keys]
