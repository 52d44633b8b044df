# SPDX-License-Identifier: Apache-2.0
"""Pacing of the simulation at a real-time factor."""

from __future__ import annotations

from humanoid_simulation.errors import SimulationError

MOST_LATE_S = 0.1
"""Maximum delay that is caught up with; the rest of a longer one is skipped."""
_WINDOW_S = 1.0
_LARGEST_FACTOR = 100.0


class Pacer:
    """
    Schedules the control periods at a real-time factor, and measures the one that is reached.

    The factor is the simulated time per real time; 0 is as fast as possible. All times except the
    period are those of a monotonic clock.

    Parameters
    ----------
    period_s
        Control period, in simulated time.
    factor
        The real-time factor, from 0 to 100.
    now_s
        Current time, at which the first period is due.

    Raises
    ------
    SimulationError
        The factor is below 0 or above 100.

    """

    def __init__(self, period_s: float, factor: float, now_s: float) -> None:
        self._period_s = period_s
        self._factor = _checked(factor)
        self.restart(now_s)

    @property
    def factor(self) -> float:
        """Return the real-time factor that is set."""
        return self._factor

    @property
    def interval_s(self) -> float:
        """Return the real time between two periods; zero is as little as possible."""
        return self._period_s / self._factor if self._factor else 0.0

    def change(self, factor: float, now_s: float) -> None:
        """
        Set the real-time factor, and restart pacing and measuring.

        Parameters
        ----------
        factor
            Simulated seconds per real second; 0 is as fast as possible.
        now_s
            Current time of a monotonic clock.

        Raises
        ------
        SimulationError
            The factor is below 0 or above 100.

        """
        self._factor = _checked(factor)
        self.restart(now_s)

    def restart(self, now_s: float) -> None:
        """
        Resume after a pause, without catching up on missed periods.

        Parameters
        ----------
        now_s
            Current time of a monotonic clock, at which the next period is due.

        """
        self._next_s = now_s
        self._window_start_s = now_s
        self._periods = 0
        self._reached: float | None = None

    def wait_s(self, now_s: float) -> float:
        """
        Compute the real time in s until the next period is due; 0 if it is due.

        Parameters
        ----------
        now_s
            Current time of a monotonic clock.

        """
        return 0.0 if self._factor == 0.0 else max(0.0, self._next_s - now_s)

    def ticked(self, now_s: float) -> None:
        """
        Schedule the next period after one was computed, and measure the real-time factor.

        Parameters
        ----------
        now_s
            Current time of a monotonic clock.

        """
        self._periods += 1
        if self._factor > 0.0:
            self._next_s = max(self._next_s + self._period_s / self._factor, now_s - MOST_LATE_S)
        elapsed_s = now_s - self._window_start_s
        if elapsed_s >= _WINDOW_S:
            self._reached = self._periods * self._period_s / elapsed_s
            self._window_start_s, self._periods = now_s, 0

    @property
    def reached(self) -> float | None:
        """Return the factor reached in the last second; None before the first one has passed."""
        return self._reached


def _checked(factor: float) -> float:
    """Validate the range of a real-time factor."""
    if not 0.0 <= factor <= _LARGEST_FACTOR:
        raise SimulationError(
            f'The real-time factor cannot be {factor:g}. Give 1 for real time, 2 for twice as '
            f'fast, up to {_LARGEST_FACTOR:g}, or 0 for as fast as possible.'
        )
    return factor
