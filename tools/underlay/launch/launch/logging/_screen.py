# SPDX-License-Identifier: Apache-2.0
"""The one writer to the screen."""

from __future__ import annotations

from collections.abc import Callable
import os
import sys
from typing import Optional


class Screen:
    """Writes whole lines to the standard output, until nobody reads it any more."""

    def __init__(self) -> None:
        """Create the writer."""
        self._on_closed: Optional[Callable[[], None]] = None
        self._is_unread = False
        self._broken_stream: Optional[object] = None

    def when_closed(self, callback: Optional[Callable[[], None]]) -> None:
        """Call a function when nobody reads any more, at once if that is so already."""
        self._on_closed = callback
        if callback is not None and self._is_unread and sys.stdout is self._broken_stream:
            callback()

    def has_colours(self) -> bool:
        """Return whether the standard output is a terminal on which colours are wanted."""
        unwanted = os.environ.get('NO_COLOR') or os.environ.get('RCUTILS_COLORIZED_OUTPUT') == '0'
        try:
            return not unwanted and sys.stdout is not None and sys.stdout.isatty()
        except ValueError:  # it is closed
            return False

    def write_line(self, text: str) -> None:
        """Write a line at once; what cannot be encoded is escaped."""
        stream = sys.stdout
        if stream is None or stream is self._broken_stream:
            return
        try:
            stream.write(_encodable(text, stream.encoding or 'utf-8') + '\n')
            stream.flush()
        except (OSError, ValueError) as error:
            self._give_up(stream, error)

    def _give_up(self, stream: object, error: Exception) -> None:
        """Remember that the stream is closed, and tell who wants to know it."""
        self._broken_stream = stream
        if stream is sys.__stdout__ and isinstance(error, OSError):
            _discard_standard_output()
        self._is_unread = isinstance(error, BrokenPipeError)
        if self._is_unread and self._on_closed is not None:
            self._on_closed()


def _encodable(text: str, encoding: str) -> str:
    return text.encode(encoding, 'backslashreplace').decode(encoding)


def _discard_standard_output() -> None:
    """Lead the standard output nowhere, so that no later flush fails."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
    finally:
        os.close(nowhere)


screen = Screen()
