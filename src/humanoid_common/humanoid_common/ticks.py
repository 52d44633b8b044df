# SPDX-License-Identifier: Apache-2.0
"""When a periodic function is due, with late calls made up for."""

from __future__ import annotations

from collections.abc import Iterator

LONGEST_DELAY_S = 1.0


class Ticks:
    """
    Evenly spaced moments.

    A computer that was busy elsewhere asks late. The moments that have passed meanwhile are all
    due then, so that the mean rate holds and no sample of a motion is left out; but none that is
    older than `LONGEST_DELAY_S`.
    """

    def __init__(self, rate_hz: float, now_s: float) -> None:
        """Begin one period after now."""
        self._period_s = 1.0 / rate_hz
        self._next_s = now_s + self._period_s

    def due(self, now_s: float) -> Iterator[float]:
        """Yield the moments up to now that have not been yielded yet, in seconds."""
        late_s = now_s - self._next_s
        if late_s > LONGEST_DELAY_S:
            self._next_s += (late_s - LONGEST_DELAY_S) // self._period_s * self._period_s
        while self._next_s <= now_s:
            yield self._next_s
            self._next_s += self._period_s
