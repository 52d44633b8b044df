# SPDX-License-Identifier: Apache-2.0
"""Write to a descriptor that takes nothing for the moment, without waiting for it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
import os
import select
import threading
from typing import Optional

# A pipe that is ready takes this much at once, and so does a terminal in practice (PIPE_BUF).
_PIECE = 4096
_CONGESTED = 256 * 1024
_CLEAR = 64 * 1024


class Backlog:
    """
    Writes at once as long as the reader keeps up, and else from a thread, in order.

    Parameters
    ----------
    descriptor
        What is written to.
    on_error
        Called with the error if something cannot be written, perhaps from the thread.

    """

    def __init__(self, descriptor: int, on_error: Callable[[OSError], None]) -> None:
        self._descriptor = descriptor
        self._on_error = on_error
        self._pieces: deque[memoryview] = deque()
        self._size = 0
        self._lock = threading.Lock()
        self._thread: Optional[threading.Thread] = None
        self._waiting: list[Callable[[], None]] = []

    @property
    def is_empty(self) -> bool:
        """Return whether all is written."""
        return not self._size

    @property
    def is_congested(self) -> bool:
        """Return whether so much waits already that nobody should add to it."""
        return self._size > _CONGESTED

    def when_clear(self, callback: Callable[[], None]) -> None:
        """
        Call a function when there is room again; at once if there is.

        Parameters
        ----------
        callback
            The function, which is called from the thread unless at once.

        """
        with self._lock:
            if self._size > _CLEAR:
                self._waiting.append(callback)
                return
        callback()

    def write(self, data: bytes) -> None:
        """
        Write what can be written now and keep the rest for the thread.

        Parameters
        ----------
        data
            The bytes.

        """
        with self._lock:
            rest = memoryview(data)
            if not self._size:
                rest = self._write_what_fits(rest)
            if rest:
                self._keep(rest)

    def _write_what_fits(self, data: memoryview) -> memoryview:
        try:
            while data and _is_ready(self._descriptor):
                written = os.write(self._descriptor, data[:_PIECE])
                data = data[written:]
        except OSError as error:
            self._on_error(error)
            return data[:0]
        return data

    def _keep(self, data: memoryview) -> None:
        self._pieces.append(data)
        self._size += len(data)
        if self._thread is None:
            self._thread = threading.Thread(target=self._drain, name='screen', daemon=True)
            self._thread.start()

    def _drain(self) -> None:
        """Write piece by piece until nothing is left; the next piece starts a new thread."""
        while True:
            with self._lock:
                if not self._pieces:
                    self._thread = None
                    return
                data = self._pieces[0]
            written = self._write_or_give_up(data[:_PIECE], len(data))
            with self._lock:
                self._pieces[0] = data[written:]
                if not self._pieces[0]:
                    self._pieces.popleft()
                self._size -= written
                waiting = self._take_waiting()
            for callback in waiting:
                callback()

    def _write_or_give_up(self, piece: memoryview, size: int) -> int:
        """Write a piece and return how much; whatever cannot be written counts as well."""
        try:
            return os.write(self._descriptor, piece)
        except OSError as error:
            self._on_error(error)
            return size

    def _take_waiting(self) -> list[Callable[[], None]]:
        """Return whom to call now that there is room, each of them once."""
        if self._size > _CLEAR:
            return []
        waiting, self._waiting = self._waiting, []
        return waiting


def _is_ready(descriptor: int) -> bool:
    """Return whether a descriptor takes a piece now; one that is broken does, to say so."""
    poll = select.poll()
    poll.register(descriptor, select.POLLOUT)
    return bool(poll.poll(0))
