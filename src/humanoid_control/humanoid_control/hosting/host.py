# SPDX-License-Identifier: Apache-2.0
"""Host that runs the control loop of robots inside a node, and measures its load."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import time

from humanoid_common.running import ending
from humanoid_control.backends import Observation
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.pacing import Pace
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

SLICE_S = 0.005
"""Longest run of ticks before the node handles other callbacks."""
PAUSED_INTERVAL_S = 0.05
"""Period of the checks for input while paused, so that a stop is obeyed."""
_AT_ONCE_S = 1e-6
_EARLY = 0.25
"""A tick may start earlier by this fraction of the interval, as no timer is exact."""
Look = Callable[[], None]
Tell = Callable[[Mapping[str, Observation]], None]


class Host:
    """
    Host that ticks a control loop at a pace, in the thread of its node, once that is spun.

    Callbacks of the node run between ticks, never during one.

    Parameters
    ----------
    node
        The node whose executor runs the ticks.
    loop
        The control loop.
    pace
        Decides when a tick is due, by a steady clock.
    interval_s
        Real time between two ticks at the pace; 0 is as fast as possible.
    look
        Called before each tick, and repeatedly while paused, so that a stop is obeyed.
    tell
        Called after each tick with the observations, by robot name.

    Attributes
    ----------
    load
        Computing time of the ticks, without those while paused.

    """

    def __init__(
        self,
        node: Node,
        loop: ControlLoop,
        pace: Pace,
        interval_s: float,
        look: Look,
        tell: Tell,
    ) -> None:
        self._loop, self._pace, self._look, self._tell = loop, pace, look, tell
        self._interval_s = interval_s
        self._paused = False
        self._owed = 0
        self._done: Callable[[], None] = _nothing
        self.load = Load(time.monotonic())
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        run = ending(node, self._run)
        self._timer = node.create_timer(interval_s or _AT_ONCE_S, run, clock=steady)

    @property
    def paused(self) -> bool:
        """Whether the control loop is paused, so that time advances only by `tick`."""
        return self._paused

    @property
    def is_stepping(self) -> bool:
        """Whether steps that `tick_in_pause` requested are still pending."""
        return self._owed > 0

    def pause(self, paused: bool) -> None:
        """
        Pause or resume the control loop.

        Pending steps of `tick_in_pause` are dropped in both cases.

        Parameters
        ----------
        paused
            Whether to pause. After a pause, the missed ticks are not caught up.

        """
        self._paused = paused
        self._settle()
        if not paused:
            self._pace.restart(time.monotonic())
        self._set_timer()

    def change(self, interval_s: float) -> None:
        """
        Change the real time between two ticks; call it after the pace itself has been changed.

        Parameters
        ----------
        interval_s
            Real time between two ticks at the pace; 0 is as fast as possible.

        """
        self._interval_s = interval_s
        self._set_timer()

    def tick(self) -> None:
        """Run one control period."""
        self._look()
        self._tell(self._loop.tick())

    def tick_in_pause(self, periods: int, done: Callable[[], None]) -> None:
        """
        Step the paused control loop, as fast as possible, with callbacks of the node in between.

        Returns at once. Pending steps of an earlier call are dropped.

        Parameters
        ----------
        periods
            How many control periods to run.
        done
            Called once: after the last step, or when `pause` or another call has dropped the rest.

        """
        self._settle()
        self._owed, self._done = periods, done
        self._set_timer()

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset all robots to a named posture at their start pose; time continues.

        Parameters
        ----------
        keyframe
            As for `ControlLoop.reset`.

        """
        self._loop.reset(keyframe)

    def _run(self) -> None:
        """Run due ticks, or the pending steps while paused, for one time slice at most."""
        if self._paused:
            self._look()
            self._tick_owed()
            return
        now_s = time.monotonic()
        end_s, early_s = now_s + SLICE_S, _EARLY * self._interval_s
        while not self._paused and now_s < end_s and self._pace.wait_s(now_s) <= early_s:
            self.tick()
            before_s, now_s = now_s, time.monotonic()
            self.load.add(now_s - before_s)
            self._pace.ticked(now_s)

    def _tick_owed(self) -> None:
        """Run pending steps while paused, for one time slice at most."""
        end_s = time.monotonic() + SLICE_S
        while self._owed and time.monotonic() < end_s:
            self._owed -= 1
            self.tick()
        if not self._owed and self._done is not _nothing:
            self._settle()
            self._set_timer()

    def _settle(self) -> None:
        """Drop the pending steps, and notify the caller that requested them."""
        done, self._owed, self._done = self._done, 0, _nothing
        done()

    def _set_timer(self) -> None:
        """Set the timer to the current pace or pause."""
        pause_s = _AT_ONCE_S if self._owed else PAUSED_INTERVAL_S
        interval_s = pause_s if self._paused else self._interval_s or _AT_ONCE_S
        self._timer.timer_period_ns = int(interval_s * 1e9)
        self._timer.reset()


def _nothing() -> None:
    """Notify no one."""


@dataclass(frozen=True)
class LoadReport:
    """Load of the ticks in a measurement."""

    ticks: int
    mean_ms: float
    worst_ms: float
    share: float
    """Fraction of the time that the ticks took."""


class Load:
    """
    Measurement of the computing time of ticks.

    Parameters
    ----------
    now_s
        Time of a steady clock at the start of the measurement.

    """

    def __init__(self, now_s: float) -> None:
        self._since_s = now_s
        self._took_s: list[float] = []

    def add(self, took_s: float) -> None:
        """
        Record the computing time of one tick.

        Parameters
        ----------
        took_s
            How long the tick took, in real time.

        """
        self._took_s.append(took_s)

    def report(self, now_s: float) -> LoadReport:
        """
        Summarise the load since the last report, and start a new measurement.

        Parameters
        ----------
        now_s
            Time of the steady clock that the measurement was started with.

        """
        passed_s, took_s = now_s - self._since_s, self._took_s
        self._since_s, self._took_s = now_s, []
        busy_s = sum(took_s)
        return LoadReport(
            len(took_s),
            1e3 * busy_s / max(len(took_s), 1),
            1e3 * max(took_s, default=0.0),
            busy_s / passed_s if passed_s > 0.0 else 0.0,
        )
