# SPDX-License-Identifier: Apache-2.0
"""What has come of a writer's samples, and what is missing (8.4.10)."""

from __future__ import annotations

from collections.abc import Iterable

from ros2cli.rtps.fragments import Fragments
from ros2cli.rtps.message import acknack
from ros2cli.rtps.wire import MAX_NUMBERS

MAX_AHEAD = 10_000  # samples that are kept in mind behind one that is missing


class Stream:
    """
    The reading end of a reliable writer: which samples have come, and which are missing.

    Parameters
    ----------
    reader
        Our entity ID (4 bytes).
    writer
        The entity ID (4 bytes) of the writer; also an attribute.

    Attributes
    ----------
    fragments
        What reassembles samples that are too large for one datagram.

    """

    def __init__(self, reader: bytes, writer: bytes) -> None:
        self.writer = writer
        self.fragments = Fragments()
        self._reader = reader
        self._last: int | None = None
        self._next = 1
        self._ahead: set[int] = set()
        self._requests = 0
        self._requested = 0

    @property
    def is_announced(self) -> bool:
        """Tell if the writer has said what it has."""
        return self._last is not None

    @property
    def is_complete(self) -> bool:
        """Tell if all has come that the writer has, as far as it has said."""
        return self._last is not None and self._next > self._last

    @property
    def is_answered(self) -> bool:
        """Tell if all has come that was asked for, but not all that there is."""
        return not self.is_complete and self._next > self._requested > 0

    def on_heartbeat(self, first: int, last: int) -> bool:
        """
        Take in which sequence numbers the writer has.

        Parameters
        ----------
        first, last
            The least and the greatest sequence number; what is before the first will never come.

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
        Whether a sample has not come yet; most come twice.

        Parameters
        ----------
        number
            Its sequence number.

        """
        return self._next <= number < self._next + MAX_AHEAD and number not in self._ahead

    def settle(self, numbers: Iterable[int]) -> None:
        """
        Mark samples that have come, or will never come.

        Parameters
        ----------
        numbers
            Their sequence numbers.

        """
        self._ahead.update(number for number in numbers if self.wants(number))
        self._advance(self._next)

    def skip(self, start: int, end: int) -> None:
        """
        Mark a range of samples that will never come.

        Parameters
        ----------
        start, end
            The first sequence number, and that after the last.

        """
        if start <= self._next:
            self._advance(end)
        else:
            self.settle(range(start, min(end, self._next + MAX_AHEAD)))

    def request(self) -> bytes:
        """
        Return the submessage that tells what has come and asks for what is missing.

        As long as nothing is known it asks for a heartbeat.
        """
        base = 0 if self._last is None else self._next
        end = min(self._last or 0, base + MAX_NUMBERS - 1) + 1
        missing = [number for number in range(base, end) if number not in self._ahead]
        self._requests += 1
        self._requested = max(missing, default=0)
        return acknack(self._reader, self.writer, base, missing, self._requests)

    def _advance(self, to: int) -> None:
        if to > self._next:
            self._next = to
            self._ahead = {number for number in self._ahead if number >= to}
        while self._next in self._ahead:
            self._ahead.remove(self._next)
            self._next += 1
