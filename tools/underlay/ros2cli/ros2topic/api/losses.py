# SPDX-License-Identifier: Apache-2.0
"""Notice messages that were lost, also those for which the middleware reports nothing."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any


class LossCounter:
    """
    Counts the gaps in the numbers that a publisher gives its messages.

    A queue that overflows because the reader is slow drops messages without an event. The numbers
    tell, as long as they all come from one publisher.
    """

    def __init__(self, has_one_publisher: Callable[[], bool]) -> None:
        """Start; the publishers are only looked at when there is a gap."""
        self._has_one_publisher = has_one_publisher
        self._last: int | None = None
        self.total = 0

    def report_gap(self, info: Mapping[str, Any]) -> str:
        """Return the text about the messages missing before this one, or ''."""
        number = info['publication_sequence_number']
        if number is None:
            return ''
        lost = 0 if self._last is None else number - self._last - 1
        self._last = number
        if lost <= 0 or not self._has_one_publisher():
            return ''
        self.total += lost
        return lost_text(lost, self.total)


def lost_text(change: int, total: int) -> str:
    """Return the block of text that stands between messages for those that are lost."""
    return f'A message was lost!!!\n\ttotal count change:{change}\n\ttotal count: {total}---\n'
