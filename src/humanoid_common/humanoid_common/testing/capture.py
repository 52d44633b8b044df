# SPDX-License-Identifier: Apache-2.0
"""Read a stream in the background."""

from __future__ import annotations

import threading
from typing import IO


class Capture:
    """
    Collector of the output of a stream, as text, in a thread of its own.

    Parameters
    ----------
    stream
        The stream to read, from now on; it is closed at its end.

    Raises
    ------
    ValueError
        There is no stream.

    """

    def __init__(self, stream: IO[bytes] | None) -> None:
        if stream is None:
            raise ValueError('There is no stream to read: start the program with pipes.')
        self._stream = stream
        self._chunks: list[bytes] = []
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    @property
    def text(self) -> str:
        """Return the output so far."""
        return b''.join(self._chunks).decode(errors='replace')

    def join(self, timeout_s: float) -> None:
        """
        Wait until the stream has ended.

        Parameters
        ----------
        timeout_s
            Maximum time to wait.

        """
        self._thread.join(timeout_s)

    def _read(self) -> None:
        """Read line by line until the end."""
        with self._stream:
            for line in self._stream:
                self._chunks.append(line)
