# SPDX-License-Identifier: Apache-2.0
"""Tell the robot's time by a clock that may be set, or stand still."""

from __future__ import annotations

from typing import Optional

MOST_OFF_S = 0.2
"""A computer that was busy, or slept, makes the robot's time late for good: the stamps are not."""


class Stamps:
    """Turns moments of the robot's time, which are regular, into those of a clock."""

    def __init__(self) -> None:
        """Begin with the robot's time as it is."""
        self._ahead_s = 0.0
        self._clock_s = 0.0

    def stamp_s(self, robot_s: float, clock_s: float) -> Optional[float]:
        """Return the stamp of a moment, None while the clock stands still or has no time yet."""
        stands, self._clock_s = clock_s == self._clock_s, clock_s
        if clock_s <= 0.0:
            return None
        off_s = robot_s + self._ahead_s - clock_s
        if abs(off_s) > MOST_OFF_S:
            if stands:
                return None
            self._ahead_s = clock_s - robot_s
        return robot_s + self._ahead_s
