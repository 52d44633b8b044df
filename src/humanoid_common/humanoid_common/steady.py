# SPDX-License-Identifier: Apache-2.0
"""A timer for control loops, on a clock that nobody sets."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_common.ticks import Ticks
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

_NANOSECONDS = 1_000_000_000


class SteadyTimer:
    """
    Calls a function at a steady rate, with the seconds since the timer was made.

    The times are evenly spaced: calls that the computer is late for are made up for, with the
    times at which they were due.
    """

    def __init__(self, node: Node, rate_hz: float, callback: Callable[[float], None]) -> None:
        """Start the timer on a node."""
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)
        self._start = self._clock.now()
        self._callback = callback
        self._ticks = Ticks(rate_hz, 0.0)
        self._timer = node.create_timer(1.0 / rate_hz, self._call, clock=self._clock)

    def now_s(self) -> float:
        """Return the seconds since the timer was made."""
        elapsed_ns: int = (self._clock.now() - self._start).nanoseconds
        return elapsed_ns / _NANOSECONDS

    def set_rate(self, rate_hz: float) -> None:
        """Change the rate at once; the time goes on without a jump."""
        period_ns = int(_NANOSECONDS / rate_hz)
        if period_ns != self._timer.timer_period_ns:
            self._ticks = Ticks(rate_hz, self.now_s())
            self._timer.timer_period_ns = period_ns
            self._timer.reset()

    def _call(self) -> None:
        """Hand each time that is due to the function."""
        for due_s in self._ticks.due(self.now_s()):
            self._callback(due_s)
