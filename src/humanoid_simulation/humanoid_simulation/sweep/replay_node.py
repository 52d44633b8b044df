# SPDX-License-Identifier: Apache-2.0
"""The node that does a finished run of a sweep again, at the pace of real time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import math
from pathlib import Path
import time
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import LATCHED, STATE
from humanoid_common.running import ending
from humanoid_simulation.sweep.conditions import conditions_of
from humanoid_simulation.sweep.motion import Motion
from humanoid_simulation.sweep.record import find_run
from humanoid_simulation.sweep.results import ending_text, FELL, FinishedRun
from humanoid_simulation.sweep.walk import Walk
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

_PERIOD_S, _MARKERS_PERIOD_S = 0.02, 0.1
_MOST_TICKS = 20
"""Maximum number of control periods at once, after which a slow computer falls behind."""
_PAUSE_S = 3.0


@dataclass(frozen=True)
class ReplayParameters:
    """Parameters of `replay`: which run, and how fast."""

    record: str = parameter('', 'The file runs.jsonl of a sweep.', read_only=True)
    key: str = parameter('', 'The key of a run, or its first digits.', read_only=True)
    speed: float = parameter(1.0, 'Simulated seconds per real second.', at_least=0.05, at_most=4.0)


class Replay(Node):
    """
    Node that does a run again and again, and publishes its true motion.

    It publishes `joint_states`, the transform from `world` to `base_link` on `tf`, the scene on
    `ground_truth/scene`, and movable objects, pushes and text on `replay`.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('replay', **options)
        self._settings = NodeParameters(self, ReplayParameters)
        self._run = self._find()
        self._joint_states = self.create_publisher(JointState, 'joint_states', STATE)
        self._tf = self.create_publisher(TFMessage, 'tf', STATE)
        self._markers = self.create_publisher(MarkerArray, 'replay', STATE)
        self._scene = self.create_publisher(MarkerArray, 'ground_truth/scene', LATCHED)
        self._begin()
        self._scene.publish(self._motion.scene_markers())
        self.get_logger().info(f'Replaying run {self._run.key}: {ending_text(self._run)}')
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self.create_timer(_PERIOD_S, ending(self, self._go_on), clock=steady)

    def _find(self) -> FinishedRun:
        """Find the run, or raise UserError."""
        parameters = self._settings.current
        if not parameters.record or not parameters.key:
            raise UserError(
                "Nothing to replay: set the parameters 'record' and 'key', or use 'ros2 run "
                "humanoid_simulation sweep EXPERIMENT --replay KEY'."
            )
        return find_run(Path(parameters.record), parameters.key)

    def _begin(self) -> None:
        """Put the robot at the start of the run."""
        try:
            self._walk = Walk(conditions_of(dict(self._run.conditions)))
        except UserError as error:
            raise UserError(
                f'Run {self._run.key} cannot be simulated, so there is nothing to show. {error}'
            ) from error
        self._motion = Motion(self._walk.robot.backend)
        self._ticks: Iterator[None] | None = self._walk.ticks()
        self._last_s, self._ahead_s, self._markers_s = time.monotonic(), 0.0, -math.inf
        self._outcome, self._end_s, self._ended_s = '', 0.0, math.inf

    def _go_on(self) -> None:
        """Let the time pass that has passed in reality, and publish."""
        now_s = time.monotonic()
        if now_s - self._ended_s > _PAUSE_S:
            self._begin()
            return
        self._advance((now_s - self._last_s) * self._settings.current.speed)
        self._last_s = now_s
        stamp = self.get_clock().now().to_msg()
        self._joint_states.publish(self._motion.joint_states(stamp))
        self._tf.publish(self._motion.transform(stamp))
        if now_s - self._markers_s >= _MARKERS_PERIOD_S:
            self._markers_s = now_s
            walk = self._walk
            self._markers.publish(self._motion.markers(self._title(), walk.push_ns, walk.push_s))

    def _advance(self, passed_s: float) -> None:
        """Do the control periods that are due."""
        self._ahead_s += passed_s
        period_s = self._walk.robot.backend.period_s
        for _ in range(_MOST_TICKS):
            if self._ahead_s < period_s:
                return
            self._ahead_s -= period_s
            try:
                self._tick()
            except UserError as error:
                self._end(str(error))
        self._ahead_s = 0.0

    def _tick(self) -> None:
        """Do one control period of the run; after a fall, let the robot come to rest."""
        if self._ticks is not None:
            try:
                next(self._ticks)
            except StopIteration:
                self._end(self._walk.result().outcome)
        elif self._outcome == FELL:
            self._walk.robot.tick()

    def _end(self, outcome: str) -> None:
        """Note that the run is over; it starts again after a pause."""
        self._ticks, self._outcome, self._ended_s = None, outcome, time.monotonic()
        self._end_s = self._walk.robot.backend.time_s
        self.get_logger().info(f'The run has ended: {self._title()}')

    def _title(self) -> str:
        """Return the text above the robot."""
        command = self._walk.segment.command
        if self._ticks is None:
            time_s, state = self._end_s, self._outcome
        else:
            time_s = self._walk.robot.backend.time_s
            state = (
                f'commanded {command.forward_m_s:.2f} {command.left_m_s:.2f} '
                f'{command.turn_rad_s:.2f}'
            )
        return f'{self._run.key[:8]}  {time_s:.1f} s  {state}'
