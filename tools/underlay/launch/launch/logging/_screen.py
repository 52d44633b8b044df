# SPDX-License-Identifier: Apache-2.0
"""The only writer to the screen, which never waits for a slow reader."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
import os
import select
import sys
import threading
from typing import Any, Optional

# A ready pipe accepts this much at once, and so does a terminal in practice (PIPE_BUF).
_PIECE = 4096
_CONGESTED = 256 * 1024
_CLEAR = 64 * 1024


class Screen:
    """
    Writer of whole lines to the standard output, until its reader is gone.

    A slow reader or a stopped terminal never blocks the launch.
    """

    def __init__(self) -> None:
        self._on_closed: Optional[Callable[[], None]] = None
        self._is_unread = False
        self._broken_stream: Optional[object] = None
        self._stream: Optional[object] = None
        self._backlog: Optional[Backlog] = None

    def when_closed(self, callback: Optional[Callable[[], None]]) -> None:
        """
        Set the callback for when the reader of the standard output is gone.

        Parameters
        ----------
        callback
            The function, which is called at once if the reader is already gone; None for nothing.

        """
        self._on_closed = callback
        if callback is not None and self._is_unread and sys.stdout is self._broken_stream:
            callback()

    @property
    def is_up_to_date(self) -> bool:
        """Whether the reader has received all output."""
        return self._backlog is None or self._backlog.is_empty

    @property
    def is_congested(self) -> bool:
        """Whether the reader is so far behind that no more should be written."""
        return self._backlog is not None and self._backlog.is_congested

    def when_clear(self, callback: Callable[[], None]) -> None:
        """
        Call a function when the reader has caught up; at once if it has.

        Parameters
        ----------
        callback
            The function, which may be called from another thread.

        """
        if self._backlog is None:
            callback()
        else:
            self._backlog.when_clear(callback)

    def has_colours(self) -> bool:
        """Check whether the standard output is a terminal on which colours are wanted."""
        unwanted = os.environ.get('NO_COLOR') or os.environ.get('RCUTILS_COLORIZED_OUTPUT') == '0'
        try:
            return not unwanted and sys.stdout is not None and sys.stdout.isatty()
        except ValueError:  # it is closed
            return False

    def write_line(self, text: str) -> None:
        """
        Write one or more lines; characters that cannot be encoded are escaped.

        Parameters
        ----------
        text
            The lines, without a line break at the end.

        """
        stream = sys.stdout
        if stream is None or stream is self._broken_stream:
            return
        data = (text + '\n').encode(stream.encoding or 'utf-8', 'backslashreplace')
        try:
            self._write(stream, data)
        except (OSError, ValueError) as error:
            self._give_up(stream, error)

    def _write(self, stream: Any, data: bytes) -> None:
        """Write to the file descriptor of a stream, or to the stream if there is none."""
        stream.flush()
        if stream is not self._stream:
            self._stream = stream
            self._backlog = self._backlog_of(stream)
        if self._backlog is None:
            stream.write(data.decode(stream.encoding or 'utf-8'))
        else:
            self._backlog.write(data)

    def _backlog_of(self, stream: Any) -> Optional[Backlog]:
        try:
            descriptor = stream.fileno()
        except (AttributeError, OSError):
            return None
        return Backlog(descriptor, lambda error: self._give_up(stream, error))

    def _give_up(self, stream: object, error: Exception) -> None:
        """Mark the stream as closed, and call the callback if its reader is gone."""
        self._broken_stream = stream
        if stream is sys.__stdout__ and isinstance(error, OSError):
            _discard_standard_output()
        self._is_unread = isinstance(error, BrokenPipeError)
        if not self._is_unread:
            _complain(error)
        elif self._on_closed is not None:
            self._on_closed()


def _complain(error: Exception) -> None:
    """Report lost output on the standard error, if it is available."""
    if sys.stderr is None or not isinstance(error, OSError):
        return
    try:
        print(f'The output can no longer be written: {error.strerror}', file=sys.stderr)
    except (OSError, ValueError):
        pass  # there is none


def _discard_standard_output() -> None:
    """Redirect the standard output to /dev/null, so that no later flush fails."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
    finally:
        os.close(nowhere)


screen = Screen()


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
