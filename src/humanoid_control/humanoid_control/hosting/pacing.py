# SPDX-License-Identifier: Apache-2.0
"""When the next tick is due."""

from __future__ import annotations

from typing import Protocol

_EARLY = 0.25
"""A tick may begin earlier by this share of a period: timers are never exactly in step."""


class Pace(Protocol):
    """Says when to let a period pass."""

    @property
    def interval_s(self) -> float:
        """Return the time between two ticks on the computer's clock; 0 is as fast as possible."""

    def is_due(self, now_s: float) -> bool:
        """Tell, on the computer's clock, whether a tick is due; true means that it is done."""


class RealTimePace:
    """
    A tick each interval, with late ticks made up for.

    What the computer is behind by more than a moment is given up: the robot's time is then late
    for good, rather than in a hurry.
    """

    def __init__(self, interval_s: float, most_behind_s: float = 0.1) -> None:
        """Begin with the first tick at once."""
        self._interval_s, self._most_behind_s = interval_s, most_behind_s
        self._next_s: float | None = None

    @property
    def interval_s(self) -> float:
        """Return the time between two ticks."""
        return self._interval_s

    def is_due(self, now_s: float) -> bool:
        """Tell whether a tick is due."""
        if self._next_s is None:
            self._next_s = now_s
        if now_s < self._next_s - _EARLY * self._interval_s:
            return False
        earliest_s = now_s - self._most_behind_s
        self._next_s = max(self._next_s, earliest_s) + self._interval_s
        return True
