# SPDX-License-Identifier: Apache-2.0
"""Command timeout, in the robot's time and in the computer's."""

from __future__ import annotations

from collections.abc import Callable
import math

Clock = Callable[[], float]


class Silence:
    """
    Timeout since the last input, such as a command.

    It must have passed in both the robot's time and the computer's: the robot's time may run many
    times faster than the operator's, or stand still while the simulator is paused.

    Parameters
    ----------
    timeout_s
        Time without input until the timeout.
    clock
        Returns the computer's time in s; without it only the robot's time counts.

    """

    def __init__(self, timeout_s: float, clock: Clock | None = None) -> None:
        self._timeout_s = timeout_s
        self._clock: Clock = clock or (lambda: math.inf)
        self._unheard = True
        self._fresh = False
        self._heard_s = self._heard_clock_s = -math.inf

    def heard(self) -> None:
        """Restart the timeout on an input."""
        self._unheard, self._fresh = False, True
        self._heard_clock_s = self._clock()

    def end(self) -> None:
        """Expire at once; the next input restarts the timeout."""
        self._unheard = True

    def lasts(self, now_s: float) -> bool:
        """
        Check whether the timeout has passed since the last input.

        Call it in every period: the timeout counts from the first call after `heard`.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        bool
            Also true before the first input, and after `end` until the next one.

        """
        if self._fresh:
            self._fresh, self._heard_s = False, now_s
        if not self._unheard and now_s - self._heard_s >= self._timeout_s:
            clock_s = self._clock()
            self._unheard = clock_s == math.inf or clock_s - self._heard_clock_s >= self._timeout_s
        return self._unheard
