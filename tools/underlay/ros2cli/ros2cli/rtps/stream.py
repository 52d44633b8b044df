# SPDX-License-Identifier: Apache-2.0
"""What has come of a writer's samples, and what is missing (8.4.10)."""

from __future__ import annotations

from collections.abc import Iterable

from ros2cli.rtps.wire import acknack

MAX_SAMPLES = 100_000


class Stream:
    """The reading end of a reliable writer."""

    def __init__(self, reader: bytes, writer: bytes) -> None:
        """Know nothing yet of what the writer has."""
        self.writer = writer
        self._reader = reader
        self._last: int | None = None
        self._missing: set[int] = set()
        self._settled: set[int] = set()
        self._requests = 0

    @property
    def is_complete(self) -> bool:
        """Tell if all has come that the writer has, as far as it has said."""
        return self._last is not None and not self._missing

    def on_heartbeat(self, first: int, last: int) -> bool:
        """Learn which sequence numbers there are; return whether that asks for more."""
        known = self._last or 0
        if last - max(first, known) > MAX_SAMPLES:
            raise ValueError(f'{last - first} samples of one writer')
        is_news = self._last is None or last > known
        self._last = max(last, known)
        self._missing = {number for number in self._missing if number >= first}
        self._missing.update(range(max(first, known + 1), last + 1))
        self._missing -= self._settled
        return is_news and not self.is_complete

    def has(self, number: int) -> bool:
        """Tell if a sample is there already; most come twice."""
        return number in self._settled

    def settle(self, numbers: Iterable[int]) -> None:
        """Note what has come, or will never come."""
        self._settled.update(numbers)
        self._missing.difference_update(numbers)

    def request(self) -> bytes:
        """
        Return the submessage that tells what has come and asks for what is missing.

        As long as nothing is known it asks for a heartbeat.
        """
        missing = sorted(self._missing)
        self._requests += 1
        unknown = 0 if self._last is None else self._last + 1
        base = missing[0] if missing else unknown
        return acknack(self._reader, self.writer, base, missing, self._requests)
