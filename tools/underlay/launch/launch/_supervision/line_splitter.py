# SPDX-License-Identifier: Apache-2.0
"""Cut a stream of bytes into lines of text."""

from __future__ import annotations


class LineSplitter:
    """Collects bytes and returns the lines that are complete."""

    def __init__(self) -> None:
        """Create an empty splitter."""
        self._pieces: list[bytes] = []

    def feed(self, data: bytes) -> list[str]:
        """Return the lines that are complete with these bytes."""
        if b'\n' not in data:
            self._pieces.append(data)
            return []
        lines, _, rest = b''.join([*self._pieces, data]).rpartition(b'\n')
        self._pieces = [rest] if rest else []
        return _decode(lines)

    def flush(self) -> list[str]:
        """Return what stands behind the last line break, as a line if there is something."""
        rest = b''.join(self._pieces)
        self._pieces = []
        return _decode(rest) if rest else []


def _decode(data: bytes) -> list[str]:
    """Return the lines as texts; a pseudo terminal adds a carriage return to each."""
    lines = data.decode('utf-8', 'replace').split('\n')
    return [line.rstrip('\r') for line in lines] if b'\r' in data else lines
