# SPDX-License-Identifier: Apache-2.0
"""Read what a process writes."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
import os

_CHUNK = 65536
_CHUNKS_AT_THE_END = 64


class OutputStream:
    """Hands what comes out of a pipe or a pseudo terminal to a function."""

    def __init__(
        self,
        loop: asyncio.AbstractEventLoop,
        descriptor: int,
        use: Callable[[bytes], None],
    ) -> None:
        """Start to read from a descriptor, which the stream owns from now on."""
        self._loop = loop
        self._descriptor = descriptor
        self._use = use
        os.set_blocking(descriptor, False)
        loop.add_reader(descriptor, self._read)

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
        """Read what is there now."""
        for _ in range(_CHUNKS_AT_THE_END):
            if not self._read():
                return

    def close(self) -> None:
        """Read no more."""
        if self._descriptor >= 0:
            self._loop.remove_reader(self._descriptor)
            os.close(self._descriptor)
            self._descriptor = -1
