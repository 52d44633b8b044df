# SPDX-License-Identifier: Apache-2.0
"""Periodic timer by the clock of its node."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_common.ticks import Ticks
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

_NANOSECONDS = 1_000_000_000


class PeriodicTimer:
    """
    Timer that calls a function at a constant rate, with the seconds since the first call.

    With `use_sim_time` these are seconds of `/clock`: motion that the function generates pauses
    and slows down with the simulation. Otherwise they are those of a steady clock. Which of the
    two is used is decided when the timer is created.

    The times are evenly spaced: late calls are made up for, with the times at which they were due.

    Parameters
    ----------
    node
        The node whose clock is used, and whose executor makes the calls.
    rate_hz
        Calls per second of that clock.
    callback
        Receives the time of the call in seconds, which starts at 0.0 and never decreases.

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
        Change the rate of the calls at once; their time continues without a jump.

        Parameters
        ----------
        rate_hz
            Calls per second of the clock of the timer.

        """
        period_ns = int(_NANOSECONDS / rate_hz)
        if period_ns != self._timer.timer_period_ns:
            self._ticks.set_rate(rate_hz, self._clock.now().nanoseconds)
            self._timer.timer_period_ns = period_ns
            self._timer.reset()

    def _call(self) -> None:
        """Call the function for each time that is due."""
        for due_s in self._ticks.due(self._clock.now().nanoseconds):
            self._callback(due_s)


def _clock_of(node: Node) -> Clock:
    """Return the clock of the node if its time is simulated, else a steady clock."""
    clock = node.get_clock()
    return clock if clock.ros_time_is_active else Clock(clock_type=ClockType.STEADY_TIME)
