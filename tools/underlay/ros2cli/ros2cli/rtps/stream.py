# SPDX-License-Identifier: Apache-2.0
"""What a reliable reader has received, and what it requests again (8.4.10, 8.4.14.1)."""

from __future__ import annotations

from collections.abc import Iterable

from ros2cli.rtps.identifiers import MAX_NUMBERS

MAX_AHEAD = 10_000  # received samples that are tracked behind a missing one
MAX_SAMPLE_BYTES = 1 << 24


class Stream:
    """
    State of a reader of a reliable writer: the received and the missing samples.

    Parameters
    ----------
    reader, writer
        Our entity ID and that of the writer (4 bytes each); also attributes.

    Attributes
    ----------
    fragments
        The reassembly of samples that are too large for one datagram.

    """

    def __init__(self, reader: bytes, writer: bytes) -> None:
        self.reader = reader
        self.writer = writer
        self.fragments = Fragments()
        self._last: int | None = None
        self._next = 1
        self._ahead: set[int] = set()
        self._requests = 0
        self._requested = 0

    @property
    def is_announced(self) -> bool:
        """Whether the writer has announced its samples."""
        return self._last is not None

    @property
    def is_complete(self) -> bool:
        """Whether all announced samples have been received."""
        return self._last is not None and self._next > self._last

    @property
    def is_answered(self) -> bool:
        """Whether all requested samples have been received, but not all announced ones."""
        return not self.is_complete and self._next > self._requested > 0

    def on_heartbeat(self, first: int, last: int) -> bool:
        """
        Handle a heartbeat with the sequence numbers that the writer has.

        Parameters
        ----------
        first, last
            The lowest and the highest sequence number; earlier samples will never arrive.

        Returns
        -------
        bool
            Whether there are new samples to request.

        """
        is_news = self._last is None or last > self._last
        self._last = max(last, self._last or 0)
        self._advance(first)
        return is_news and not self.is_complete

    def wants(self, number: int) -> bool:
        """
        Whether a sample has not been received yet; most arrive twice.

        Parameters
        ----------
        number
            Its sequence number.

        """
        return self._next <= number < self._next + MAX_AHEAD and number not in self._ahead

    def settle(self, numbers: Iterable[int]) -> None:
        """
        Mark samples as received or as never to arrive.

        Parameters
        ----------
        numbers
            Their sequence numbers.

        """
        self._ahead.update(number for number in numbers if self.wants(number))
        self._advance(self._next)

    def want_last(self) -> None:
        """Count the last sample as missing, to see whether the writer still answers."""
        if self._last:
            self._next = min(self._next, self._last)
            self._ahead.clear()

    def skip(self, start: int, end: int) -> None:
        """
        Mark a range of samples as never to arrive.

        Parameters
        ----------
        start, end
            The first sequence number, and the one after the last.

        """
        if start <= self._next:
            self._advance(end)
        else:
            self.settle(range(start, min(end, self._next + MAX_AHEAD)))

    def request(self) -> tuple[int, list[int], int]:
        """
        Return what the next ACKNACK acknowledges and requests; it counts as sent.

        Returns
        -------
        tuple of int, list of int and int
            The sequence number before which all samples have been received, 0 to request only a
            heartbeat, since there was none yet; the missing numbers; the number of the request.

        """
        base = 0 if self._last is None else self._next
        end = min(self._last or 0, base + MAX_NUMBERS - 1) + 1
        missing = [number for number in range(base, end) if number not in self._ahead]
        self._requests += 1
        self._requested = max(missing, default=0)
        return base, missing, self._requests

    def _advance(self, to: int) -> None:
        if to > self._next:
            self._next = to
            self._ahead = {number for number in self._ahead if number >= to}
        while self._next in self._ahead:
            self._ahead.remove(self._next)
            self._next += 1


class Fragments:
    """Fragments of a writer's latest sample; if one is lost, all are requested again."""

    def __init__(self) -> None:
        """Start without fragments."""
        self._number = 0
        self._parts: dict[int, bytes] = {}
        self._missing = 0

    def add(self, number: int, size: int, start: int, part: bytes) -> bytes | None:
        """
        Add a fragment, and reassemble the sample when it is complete.

        Parameters
        ----------
        number, size
            The sequence number of the sample and its size; the fragments of the previous sample
            are dropped when the number is another one.
        start, part
            The offset of the fragment in the sample, and its content.

        Returns
        -------
        bytes or None
            The whole sample if this was the last missing fragment.

        Raises
        ------
        ValueError
            The declared sample size is larger than 16 MiB.

        """
        if size > MAX_SAMPLE_BYTES:
            raise ValueError(f'a sample of {size} bytes')
        if number != self._number:
            self._number, self._missing = number, size
            self._parts.clear()
        if part and start not in self._parts:
            self._parts[start] = part
            self._missing -= len(part)
        if self._missing > 0:
            return None
        self._number = 0
        whole = b''.join(part for _, part in sorted(self._parts.items()))[:size]
        self._parts.clear()
        return whole
