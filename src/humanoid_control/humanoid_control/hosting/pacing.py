# SPDX-License-Identifier: Apache-2.0
"""When the next tick is due; all times are those of a clock that nobody sets."""

from __future__ import annotations

from typing import Protocol


class Pace(Protocol):
    """Says when to let a period pass."""

    def wait_s(self, now_s: float) -> float:
        """Return for how long the next tick is not due yet; zero if it is."""

    def ticked(self, now_s: float) -> None:
        """Take note of a tick."""

    def restart(self, now_s: float) -> None:
        """Go on after a pause, from now."""


class RealTimePace:
    """
    A tick each period, with late ticks made up for.

    What the computer is behind by more than a moment is given up: the robot's time is then late
    for good, rather than in a hurry.
    """

    def __init__(self, period_s: float, most_behind_s: float = 0.1) -> None:
        """Begin with the first tick at once."""
        self._period_s, self._most_behind_s = period_s, most_behind_s
        self._next_s = float('-inf')

    def wait_s(self, now_s: float) -> float:
        """Return for how long the next tick is not due yet."""
        return max(self._next_s - now_s, 0.0)

    def ticked(self, now_s: float) -> None:
        """Take note of a tick."""
        self._next_s = max(self._next_s, now_s - self._most_behind_s) + self._period_s

    def restart(self, now_s: float) -> None:
        """Go on after a pause, from now."""
        self._next_s = now_s
