# SPDX-License-Identifier: Apache-2.0
"""Know when somebody who sends commands has stopped to."""

from __future__ import annotations

from collections.abc import Callable
import math

Clock = Callable[[], float]


class Silence:
    """
    Timeout since something was last heard, such as a command.

    Both the robot's time and the computer's must have passed: the robot's time may run many times
    faster than the person who drives it, or stand still while the simulator is paused.

    Parameters
    ----------
    timeout_s
        How long nothing must have been heard.
    clock
        Tells the computer's time in s; without it the robot's time alone counts.

    """

    def __init__(self, timeout_s: float, clock: Clock | None = None) -> None:
        self._timeout_s = timeout_s
        self._clock: Clock = clock or (lambda: math.inf)
        self._unheard = True
        self._fresh = False
        self._heard_s = self._heard_clock_s = -math.inf

    def heard(self) -> None:
        """Note that something came."""
        self._unheard, self._fresh = False, True
        self._heard_clock_s = self._clock()

    def end(self) -> None:
        """Be silent from now on, until something is heard."""
        self._unheard = True

    def lasts(self, now_s: float) -> bool:
        """
        Check whether the timeout has passed since something was heard.

        Call it in every period: the timeout counts from the first call after `heard`.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        bool
            True also if nothing was ever heard, or nothing since `end`.

        """
        if self._fresh:
            self._fresh, self._heard_s = False, now_s
        if not self._unheard and now_s - self._heard_s >= self._timeout_s:
            clock_s = self._clock()
            self._unheard = clock_s == math.inf or clock_s - self._heard_clock_s >= self._timeout_s
        return self._unheard
