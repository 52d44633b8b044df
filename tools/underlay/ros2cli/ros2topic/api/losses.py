# SPDX-License-Identifier: Apache-2.0
"""Detection of lost messages, including those that the middleware does not report."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any


class LossCounter:
    """
    Counter of the gaps in the sequence numbers of a publisher.

    A queue that overflows because the reader is slow drops messages without an event. The sequence
    numbers reveal this, as long as they all come from one publisher.

    Parameters
    ----------
    has_one_publisher
        Whether the topic has exactly one publisher; only called when there is a gap.

    Attributes
    ----------
    total
        The number of messages lost so far.

    """

    def __init__(self, has_one_publisher: Callable[[], bool]) -> None:
        self._has_one_publisher = has_one_publisher
        self._last: int | None = None
        self.total = 0

    def report_gap(self, info: Mapping[str, Any]) -> str:
        """
        Count the messages missing before this one, and format the report.

        Call once for each message, in the order of arrival.

        Parameters
        ----------
        info
            The message info of rclpy, with `publication_sequence_number`, which may be None.

        Returns
        -------
        str
            The report, or '' if nothing is known to be missing.

        """
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
    """
    Format the report of lost messages that is printed between messages.

    Parameters
    ----------
    change, total
        The number of messages lost since the last report, and in total.

    """
    return f'A message was lost!!!\n\ttotal count change:{change}\n\ttotal count: {total}---\n'
