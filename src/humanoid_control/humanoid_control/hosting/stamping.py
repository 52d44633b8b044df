# SPDX-License-Identifier: Apache-2.0
"""Message stamps: the robot's time in that of a clock that may be set or stand still."""

from __future__ import annotations

from typing import Optional

MOST_OFF_S = 0.2
"""Maximum lag of the stamps; the robot's time itself lags for good after a stall or a suspend."""


class Stamps:
    """Converter from the robot's time, which is regular, to the time of a clock."""

    def __init__(self) -> None:
        self._ahead_s = 0.0
        self._clock_s = 0.0

    def stamp_s(self, robot_s: float, clock_s: float) -> Optional[float]:
        """
        Convert the robot's time to a message stamp of a clock.

        Stamps keep the regular spacing of the robot's time. Where the two times are more than
        `MOST_OFF_S` apart, they jump to the clock.

        Parameters
        ----------
        robot_s
            The moment to stamp, in the robot's time.
        clock_s
            Current time of the clock.

        Returns
        -------
        float or None
            The stamp in s of the clock. None before the clock has a time, and once a clock that
            stands still is more than `MOST_OFF_S` behind.

        """
        stands, self._clock_s = clock_s == self._clock_s, clock_s
        if clock_s <= 0.0:
            return None
        off_s = robot_s + self._ahead_s - clock_s
        if abs(off_s) > MOST_OFF_S:
            if stands:
                return None
            self._ahead_s = clock_s - robot_s
        return robot_s + self._ahead_s
