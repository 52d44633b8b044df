# SPDX-License-Identifier: Apache-2.0
"""Rate limiting in the robot's time."""

from __future__ import annotations

_ROUNDING_S = 1e-6


class RateLimiter:
    """
    Rate limiter in the robot's time; the first call is due at once.

    Parameters
    ----------
    rate_hz
        How often `is_due` returns True; 0 is never.

    """

    def __init__(self, rate_hz: float) -> None:
        self._period_s = 1.0 / rate_hz if rate_hz > 0.0 else float('inf')
        self._next_s = float('-inf') if rate_hz > 0.0 else float('inf')

    def is_due(self, now_s: float) -> bool:
        """
        Check whether the next period is due; a call that returns True starts the following one.

        Periods that were missed are skipped; a clock that was set back restarts the schedule.

        Parameters
        ----------
        now_s
            The robot's time.

        """
        if now_s < self._next_s - self._period_s - _ROUNDING_S:
            self._next_s = now_s
        if now_s < self._next_s - _ROUNDING_S:
            return False
        self._next_s += self._period_s
        if self._next_s <= now_s:
            self._next_s = now_s + self._period_s
        return True
