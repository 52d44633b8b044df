# SPDX-License-Identifier: Apache-2.0
"""Timing: the pace of ticks, the rate of messages, and their stamps."""

from __future__ import annotations

from typing import Optional, Protocol

_ROUNDING_S = 1e-6
MOST_OFF_S = 0.2
"""Maximum lag of the stamps; the robot's time itself lags for good after a stall or a suspend."""


class Pace(Protocol):
    """Pace of a control loop, which schedules its ticks."""

    def wait_s(self, now_s: float) -> float:
        """
        Compute the time until the next tick is due.

        Parameters
        ----------
        now_s
            Time of a steady clock.

        Returns
        -------
        float
            Real time in s; zero if the tick is due.

        """

    def ticked(self, now_s: float) -> None:
        """
        Schedule the next tick after one that has just ended.

        Parameters
        ----------
        now_s
            Time of the steady clock at the end of the tick.

        """

    def restart(self, now_s: float) -> None:
        """
        Schedule the next tick for now, as after a pause: missed ticks are not caught up.

        Parameters
        ----------
        now_s
            Time of the steady clock.

        """


class RealTimePace:
    """
    Pace of one tick per period of real time, which catches up late ticks.

    A delay beyond `most_behind_s` is not caught up: the robot's time then lags for good, rather
    than running fast. The first tick is due at once.

    Parameters
    ----------
    period_s
        Real time between two ticks.
    most_behind_s
        The longest delay that is caught up.

    """

    def __init__(self, period_s: float, most_behind_s: float = 0.1) -> None:
        self._period_s, self._most_behind_s = period_s, most_behind_s
        self._next_s = float('-inf')

    def wait_s(self, now_s: float) -> float:
        """
        Compute the time until the next tick is due.

        Parameters
        ----------
        now_s
            As for `Pace.wait_s`.

        Returns
        -------
        float
            As for `Pace.wait_s`.

        """
        return max(self._next_s - now_s, 0.0)

    def ticked(self, now_s: float) -> None:
        """
        Schedule the next tick one period after the last one was due.

        A delay beyond `most_behind_s` is not caught up.

        Parameters
        ----------
        now_s
            As for `Pace.ticked`.

        """
        self._next_s = max(self._next_s, now_s - self._most_behind_s) + self._period_s

    def restart(self, now_s: float) -> None:
        """
        Schedule the next tick for now.

        Parameters
        ----------
        now_s
            As for `Pace.restart`.

        """
        self._next_s = now_s


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
