# SPDX-License-Identifier: Apache-2.0
"""Run robots inside a node."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import time

from humanoid_common.running import ending
from humanoid_control.backends import Observation
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.load import Load
from humanoid_control.hosting.pacing import Pace
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

SLICE_S = 0.005
"""After so long with ticks alone, the node hears what has come meanwhile."""
PAUSED_INTERVAL_S = 0.05
"""In a pause, the host looks so often for what has come: a stop is to be heard."""
_AT_ONCE_S = 1e-6
_EARLY = 0.25
"""A tick may begin earlier by this share of the interval: no timer is exactly in step."""
Look = Callable[[], None]
Tell = Callable[[Mapping[str, Observation]], None]


class Host:
    """
    Tick a control loop at a pace, in the thread of its node, as soon as the node is spun.

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
        Called before each tick, and repeatedly in a pause, so that a stop is obeyed.
    tell
        Called after each tick with what was observed, by the name of the robot.

    Attributes
    ----------
    load
        How long ticks take; those in a pause do not count.

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
        """Tell whether no time passes but by `tick`."""
        return self._paused

    @property
    def is_stepping(self) -> bool:
        """Tell whether periods are still to pass that `tick_in_pause` asked for."""
        return self._owed > 0

    def pause(self, paused: bool) -> None:
        """
        Pause or resume the control loop.

        Steps that `tick_in_pause` still owes are dropped in both cases.

        Parameters
        ----------
        paused
            Whether to pause. When time goes on, the pause is not caught up with.

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
        """Let one period pass."""
        self._look()
        self._tell(self._loop.tick())

    def tick_in_pause(self, periods: int, done: Callable[[], None]) -> None:
        """
        Step the paused control loop, as fast as possible, with callbacks of the node in between.

        Returns at once. Steps that an earlier call still owes are dropped.

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
        Reset all robots to a named posture at their start pose; time goes on.

        Parameters
        ----------
        keyframe
            As for `ControlLoop.reset`.

        """
        self._loop.reset(keyframe)

    def _run(self) -> None:
        """Do the ticks that are due, for a slice of time at most; in a pause, only look."""
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
        """Let periods pass in a pause, if any are to, for a slice of time at most."""
        end_s = time.monotonic() + SLICE_S
        while self._owed and time.monotonic() < end_s:
            self._owed -= 1
            self.tick()
        if not self._owed and self._done is not _nothing:
            self._settle()
            self._set_timer()

    def _settle(self) -> None:
        """Owe no periods any more, and say so to whom they were owed."""
        done, self._owed, self._done = self._done, 0, _nothing
        done()

    def _set_timer(self) -> None:
        """Let the timer follow a change of the pace, or a pause."""
        pause_s = _AT_ONCE_S if self._owed else PAUSED_INTERVAL_S
        interval_s = pause_s if self._paused else self._interval_s or _AT_ONCE_S
        self._timer.timer_period_ns = int(interval_s * 1e9)
        self._timer.reset()


def _nothing() -> None:
    """Tell nobody."""
