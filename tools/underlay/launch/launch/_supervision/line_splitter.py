# SPDX-License-Identifier: Apache-2.0
"""Split a byte stream into lines of text."""

from __future__ import annotations

_LONGEST = 1024 * 1024
"""Maximum length of a line in bytes; a longer one is split, as it may never end."""


class LineSplitter:
    """Splitter that collects bytes and returns complete lines."""

    def __init__(self) -> None:
        self._pieces: list[bytes] = []
        self._size = 0

    def feed(self, data: bytes) -> list[str]:
        """
        Add bytes, and return the lines that they complete.

        Parameters
        ----------
        data
            The next bytes of the stream.

        Returns
        -------
        list of str
            The lines without line breaks; one that is longer than 1 MiB is split.

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
        """Return the incomplete line, except for a trailing incomplete UTF-8 character."""
        text = b''.join(self._pieces)
        tail = 1
        while tail < 4 and 0x80 <= text[-tail] < 0xC0:
            tail += 1
        end = len(text) - (tail if text[-tail] >= 0xC0 else 0)
        self._keep(text[end:])
        return _decode(text[:end])

    def flush(self) -> list[str]:
        """Return the text after the last line break as a line, if there is any."""
        rest = b''.join(self._pieces)
        self._keep(b'')
        return _decode(rest) if rest else []


def _decode(data: bytes) -> list[str]:
    """Decode lines, and strip the carriage returns that a pseudo terminal adds."""
    lines = data.decode('utf-8', 'replace').split('\n')
    return [line.rstrip('\r') for line in lines] if b'\r' in data else lines
