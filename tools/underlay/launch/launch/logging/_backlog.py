# SPDX-License-Identifier: Apache-2.0
"""Write to a file descriptor that may block, without waiting for it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
import os
import select
import threading
from typing import Optional

# A ready pipe accepts this much at once, and so does a terminal in practice (PIPE_BUF).
_PIECE = 4096
_CONGESTED = 256 * 1024
_CLEAR = 64 * 1024


class Backlog:
    """
    Ordered writer that writes at once while the reader keeps up, and else from a thread.

    Parameters
    ----------
    descriptor
        The file descriptor to write to.
    on_error
        Called with the error if a write fails, possibly from the thread.

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
        """Whether all data has been written."""
        return not self._size

    @property
    def is_congested(self) -> bool:
        """Whether so much data is queued that no more should be added."""
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
        Write as much as possible now, and queue the rest for the thread.

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
        """Write piece by piece until the queue is empty; later data starts a new thread."""
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
        """Write a piece and return its number of bytes; after an error, drop everything."""
        try:
            return os.write(self._descriptor, piece)
        except OSError as error:
            self._on_error(error)
            return size

    def _take_waiting(self) -> list[Callable[[], None]]:
        """Remove and return the waiting callbacks if there is room again."""
        if self._size > _CLEAR:
            return []
        waiting, self._waiting = self._waiting, []
        return waiting


def _is_ready(descriptor: int) -> bool:
    """Check whether a descriptor is writable now; a broken one is, to report its error."""
    poll = select.poll()
    poll.register(descriptor, select.POLLOUT)
    return bool(poll.poll(0))
