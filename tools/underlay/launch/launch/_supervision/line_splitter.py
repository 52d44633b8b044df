# SPDX-License-Identifier: Apache-2.0
"""Cut a stream of bytes into lines of text."""

from __future__ import annotations

_LONGEST = 1024 * 1024
"""A line that goes on for longer is cut here, because it may never end."""


class LineSplitter:
    """Collects bytes and returns the lines that are complete."""

    def __init__(self) -> None:
        self._pieces: list[bytes] = []
        self._size = 0

    def feed(self, data: bytes) -> list[str]:
        """
        Add bytes, and return the lines that are complete with them.

        Parameters
        ----------
        data
            The next bytes of the stream.

        Returns
        -------
        list of str
            The lines without line breaks; one that is longer than 1 MiB is cut.

        """
        if b'\n' in data:
            lines, _, rest = b''.join([*self._pieces, data]).rpartition(b'\n')
            self._keep(rest)
            return _decode(lines)
        self._pieces.append(data)
        self._size += len(data)
        return self._cut() if self._size > _LONGEST else []

    def _keep(self, rest: bytes) -> None:
        self._pieces = [rest] if rest else []
        self._size = len(rest)

    def _cut(self) -> list[str]:
        """Return what there is of a line, but for a character that may be incomplete."""
        text = b''.join(self._pieces)
        tail = 1
        while tail < 4 and 0x80 <= text[-tail] < 0xC0:
            tail += 1
        end = len(text) - (tail if text[-tail] >= 0xC0 else 0)
        self._keep(text[end:])
        return _decode(text[:end])

    def flush(self) -> list[str]:
        """Return what stands behind the last line break, as a line if there is something."""
        rest = b''.join(self._pieces)
        self._keep(b'')
        return _decode(rest) if rest else []


def _decode(data: bytes) -> list[str]:
    """Return the lines as texts; a pseudo terminal adds a carriage return to each."""
    lines = data.decode('utf-8', 'replace').split('\n')
    return [line.rstrip('\r') for line in lines] if b'\r' in data else lines
