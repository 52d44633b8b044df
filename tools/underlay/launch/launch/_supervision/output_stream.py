# SPDX-License-Identifier: Apache-2.0
"""Read the output of a process."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import os

from launch.logging._screen import screen

_CHUNK = 65536
_CHUNKS_AT_THE_END = 64


class OutputStream:
    """
    Reader of a pipe or a pseudo terminal that passes the data to a callback.

    Nothing is read while the screen is congested, so that the writer blocks (back-pressure).

    Parameters
    ----------
    loop
        The event loop that watches the descriptor.
    descriptor
        The file descriptor to read from; the stream takes ownership of it.
    use
        Called with each piece of the output.

    """

    def __init__(
        self,
        loop: asyncio.AbstractEventLoop,
        descriptor: int,
        use: Callable[[bytes], None],
    ) -> None:
        self._loop = loop
        self._descriptor = descriptor
        self._use = use
        os.set_blocking(descriptor, False)
        loop.add_reader(descriptor, self._on_readable)

    def _on_readable(self) -> None:
        if not screen.is_congested:
            self._read()
            return
        self._loop.remove_reader(self._descriptor)
        screen.when_clear(self._read_on_from_any_thread)

    def _read_on_from_any_thread(self) -> None:
        try:
            self._loop.call_soon_threadsafe(self._read_on)
        except RuntimeError:  # the loop is closed; output is no longer read
            pass

    def _read_on(self) -> None:
        if self._descriptor >= 0:
            self._loop.add_reader(self._descriptor, self._on_readable)

    def _read(self) -> bool:
        """Read once; return whether there may be more."""
        if self._descriptor < 0:
            return False
        try:
            data = os.read(self._descriptor, _CHUNK)
        except (BlockingIOError, InterruptedError):
            return False
        except OSError:  # the other end of a pseudo terminal is closed
            data = b''
        if not data:
            self.close()
            return False
        self._use(data)
        return True

    def drain(self) -> None:
        """Read the data that is available now."""
        for _ in range(_CHUNKS_AT_THE_END):
            if not self._read():
                return

    def close(self) -> None:
        """Stop reading, and close the descriptor."""
        if self._descriptor >= 0:
            self._loop.remove_reader(self._descriptor)
            os.close(self._descriptor)
            self._descriptor = -1
