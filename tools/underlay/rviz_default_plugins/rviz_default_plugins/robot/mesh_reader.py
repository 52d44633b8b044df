# SPDX-License-Identifier: Apache-2.0
"""How the meshes of a robot are read in the background, while the page goes on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from threading import Thread

from rviz_common.inputs import WorkQueue
from rviz_default_plugins.robot.mesh_loading import MeshShelf

__all__ = ['MeshReader']


class MeshReader:
    """
    Reader of meshes in a thread of its own; only the newest request is answered.

    Parameters
    ----------
    queue
        The queue of the thread in which requests are answered.

    """

    def __init__(self, queue: WorkQueue) -> None:
        self._queue = queue
        self._shelf = MeshShelf()
        self._awaited: object = None

    def read(self, names: Sequence[str], take: Callable[[MeshShelf], None]) -> None:
        """
        Read meshes, and drop the request before.

        Parameters
        ----------
        names
            The names in the URDF, as for `find_file`.
        take
            Called with the meshes once they have been read: at once if there are no names.

        """
        self._awaited = awaited = object()
        shelf = MeshShelf(self._shelf)

        def finish() -> None:
            if self._awaited is awaited:
                self._shelf = shelf
                take(shelf)

        def work() -> None:
            shelf.read(names)
            self._queue.post(finish)

        if names:
            Thread(target=work, name='meshes', daemon=True).start()
        else:
            finish()

    def cancel(self) -> None:
        """Drop the last request: it is not answered."""
        self._awaited = None
