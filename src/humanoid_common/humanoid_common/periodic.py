# SPDX-License-Identifier: Apache-2.0
"""The time of a node in s, and a periodic timer by its clock, which makes up for late calls."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rclpy.clock import Clock, ClockType
from rclpy.node import Node

LONGEST_DELAY_S = 1.0
_NANOSECONDS = 1_000_000_000


def clock_s(node: Node) -> float:
    """
    Read the clock of a node, which is that of the simulation with `use_sim_time`.

    Parameters
    ----------
    node
        The node.

    Returns
    -------
    float
        The time in s.

    """
    return float(node.get_clock().now().nanoseconds) * 1e-9


class Ticks:
    """
    Evenly spaced ticks of the time since the first reading of a clock.

    On a busy computer, calls come late. All ticks that have passed meanwhile are due then, except
    those older than `LONGEST_DELAY_S`, so that the mean rate is kept and no sample of a motion is
    skipped. When the clock is set back, as by a simulator that restarts, the time continues from
    where it was.

    Parameters
    ----------
    rate_hz
        Ticks per second of the clock.

    """

    def __init__(self, rate_hz: float) -> None:
        self._period_ns = round(_NANOSECONDS / rate_hz)
        self._origin_ns: int | None = None
        self._clock_ns = 0
        self._next_ns = 0

    def due(self, clock_ns: int) -> Iterator[float]:
        """
        Yield the times of the ticks that are due and were not yielded before, oldest first.

        Parameters
        ----------
        clock_ns
            The clock, in nanoseconds. The first call yields 0.0.

        Yields
        ------
        float
            The time of the tick in seconds.

        """
        passed_ns = self._passed_ns(clock_ns)
        late_ns = passed_ns - self._next_ns - round(LONGEST_DELAY_S * _NANOSECONDS)
        if late_ns > 0:
            self._next_ns += late_ns // self._period_ns * self._period_ns
        while self._next_ns <= passed_ns:
            yield self._next_ns / _NANOSECONDS
            self._next_ns += self._period_ns

    def passed_s(self, clock_ns: int) -> float:
        """
        Compute the time since the first call of `due`, in seconds; zero before it.

        Parameters
        ----------
        clock_ns
            The clock, in nanoseconds.

        """
        return 0.0 if self._origin_ns is None else self._passed_ns(clock_ns) / _NANOSECONDS

    def set_rate(self, rate_hz: float, clock_ns: int) -> None:
        """
        Change the rate: the next tick is one new period from now.

        Parameters
        ----------
        rate_hz
            Ticks per second of the clock.
        clock_ns
            The clock, in nanoseconds.

        """
        self._period_ns = round(_NANOSECONDS / rate_hz)
        if self._origin_ns is not None:
            self._next_ns = self._passed_ns(clock_ns) + self._period_ns

    def _passed_ns(self, clock_ns: int) -> int:
        """Compute the time since the first reading of the clock; it never decreases."""
        if self._origin_ns is None:
            self._origin_ns = clock_ns
        elif clock_ns < self._clock_ns:
            self._origin_ns -= self._clock_ns - clock_ns
        self._clock_ns = clock_ns
        return clock_ns - self._origin_ns


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
