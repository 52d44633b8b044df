# SPDX-License-Identifier: Apache-2.0
"""Pacing of ticks; all times are those of a steady clock."""

from __future__ import annotations

from typing import Protocol


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
