# SPDX-License-Identifier: Apache-2.0
"""A rate limiter."""

from __future__ import annotations

import time

__all__ = ['Pace']


class Pace:
    """
    Rate limiter for work that is not done in each frame.

    Parameters
    ----------
    period_s
        The minimum time between two runs, in s of a monotonic clock.

    """

    def __init__(self, period_s: float = 0.5) -> None:
        self._period_s = period_s
        self._next_s = 0.0

    def is_due(self) -> bool:
        """Return True at most once per period, if the next run is due."""
        now_s = time.monotonic()
        if now_s < self._next_s:
            return False
        self._next_s = now_s + self._period_s
        return True

    def hurry(self) -> None:
        """Make the next run due immediately."""
        self._next_s = 0.0
