# SPDX-License-Identifier: Apache-2.0
"""The rate of a stream of events, from the times between them."""

from __future__ import annotations

from collections import deque
from math import sqrt


class RateMeter:
    """
    Measures the mean rate of events, with the extremes and standard deviation of the periods.

    Parameters
    ----------
    window
        The number of periods to keep.

    """

    def __init__(self, window: int) -> None:
        self._periods_s: deque[float] = deque(maxlen=window)
        self._last_s: float | None = None
        self._changed = False

    def add(self, now_s: float) -> None:
        """
        Count an event; a clock that jumps back restarts the measurement.

        Parameters
        ----------
        now_s
            The time of the event, in s, on any clock.

        """
        if self._last_s is not None and now_s < self._last_s:
            self._periods_s.clear()
            self._changed = False
        elif self._last_s is not None:
            self._periods_s.append(now_s - self._last_s)
            self._changed = True
        self._last_s = now_s

    def report(self) -> str:
        """Return the two lines of a report, or '' without new events since the last one."""
        if not self._changed:
            return ''
        self._changed = False
        periods = self._periods_s
        mean = sum(periods) / len(periods)
        rate = 1.0 / mean if mean > 0.0 else 0.0
        spread = sqrt(sum((period - mean) ** 2 for period in periods) / len(periods))
        return (
            f'average rate: {rate:.3f}\n\tmin: {min(periods):.3f}s max: {max(periods):.3f}s '
            f'std dev: {spread:.5f}s window: {len(periods) + 1}'
        )
