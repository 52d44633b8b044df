# SPDX-License-Identifier: Apache-2.0
"""The only writer to the screen."""

from __future__ import annotations

from collections.abc import Callable
import os
import sys
from typing import Any, Optional

from launch.logging._backlog import Backlog


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
        print(f'The output cannot be written any more: {error.strerror}', file=sys.stderr)
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
