# SPDX-License-Identifier: Apache-2.0
"""A timer for what moves in the world, by the clock of its node."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_common.ticks import Ticks
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

_NANOSECONDS = 1_000_000_000


class PeriodicTimer:
    """
    Calls a function at a steady rate, with the seconds that have passed since the first call.

    With `use_sim_time` these are seconds of `/clock`: what the function moves stands still while
    the simulation is paused, and is slow while it is slow. Otherwise they are those of a steady
    clock, which nobody sets. Which of the two it is stays as it was when the timer was made.

    The moments are evenly spaced: calls that the computer is late for are made up for, with the
    times at which they were due.

    Parameters
    ----------
    node
        The node whose clock counts, and whose executor makes the calls.
    rate_hz
        Calls in a second of that clock.
    callback
        Gets the time of the call in seconds. It begins with 0.0 and never goes back.

    """

    def __init__(self, node: Node, rate_hz: float, callback: Callable[[float], None]) -> None:
        self._callback = callback
        self._clock = _clock_of(node)
        self._ticks = Ticks(rate_hz)
        self._timer = node.create_timer(1.0 / rate_hz, self._call, clock=self._clock)

    def now_s(self) -> float:
        """Return the seconds since the first call; zero before it."""
        return self._ticks.passed_s(self._clock.now().nanoseconds)

    def set_rate(self, rate_hz: float) -> None:
        """
        Change the rate of the calls at once; their time goes on without a jump.

        Parameters
        ----------
        rate_hz
            Calls in a second of the clock of the timer.

        """
        period_ns = int(_NANOSECONDS / rate_hz)
        if period_ns != self._timer.timer_period_ns:
            self._ticks.set_rate(rate_hz, self._clock.now().nanoseconds)
            self._timer.timer_period_ns = period_ns
            self._timer.reset()

    def _call(self) -> None:
        """Hand each time that is due to the function."""
        for due_s in self._ticks.due(self._clock.now().nanoseconds):
            self._callback(due_s)


def _clock_of(node: Node) -> Clock:
    """Return the clock of the node if it is simulated, else one that nobody sets."""
    clock = node.get_clock()
    return clock if clock.ros_time_is_active else Clock(clock_type=ClockType.STEADY_TIME)
