# SPDX-License-Identifier: Apache-2.0
"""Run robots inside a node."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import time

from humanoid_control.backends import Observation
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.pacing import Pace
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

SLICE_S = 0.005
"""After so long with ticks alone, the node hears what has come meanwhile."""
_AT_ONCE_S = 1e-6
Look = Callable[[], None]
Tell = Callable[[float, Mapping[str, Observation]], None]


class Host:
    """
    Ticks a control loop at a pace, in the thread of its node.

    Callbacks of the node run between ticks, never during one. Before each tick the host looks for
    what has come; after it, it tells what was observed.
    """

    def __init__(self, node: Node, loop: ControlLoop, pace: Pace, look: Look, tell: Tell) -> None:
        """Begin to tick as soon as the node is spun."""
        self._loop, self._pace, self._look, self._tell = loop, pace, look, tell
        self._node = node
        self._timer = node.create_timer(
            pace.interval_s or _AT_ONCE_S, self._run, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )

    def change(self, pace: Pace) -> None:
        """Tick at another pace."""
        self._pace = pace
        self._timer.timer_period_ns = int((pace.interval_s or _AT_ONCE_S) * 1e9)
        self._timer.reset()

    def tick(self) -> None:
        """Let one period pass."""
        self._look()
        observations = self._loop.tick()
        self._tell(next(iter(observations.values())).time_s, observations)

    def _run(self) -> None:
        """Do the ticks that are due, for a slice of time at most."""
        now_s = time.monotonic()
        end_s = now_s + SLICE_S
        while now_s < end_s and self._pace.is_due(now_s):
            self.tick()
            now_s = time.monotonic()
