# SPDX-License-Identifier: Apache-2.0
"""Conditions on poses, and on the robot: its motion, battery and transforms."""

from __future__ import annotations

from typing import ClassVar

from nav2_behavior_tree.node import NodeConfig, TreeNode
from nav2_behavior_tree.nodes.conditions import outcome
from nav2_behavior_tree.ports import in_port, Port, REQUIRED
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus
from nav2_util import Pose2D
from sensor_msgs.msg import BatteryState

__all__ = [
    'ArePosesNear',
    'DistanceTraveled',
    'GoalReached',
    'IsBatteryCharging',
    'IsBatteryLow',
    'IsStopped',
    'IsStuck',
    'TransformAvailable',
]

RUNNING, SUCCESS, FAILURE = NodeStatus.RUNNING, NodeStatus.SUCCESS, NodeStatus.FAILURE
_FRAMES: dict[str, Port] = {
    'global_frame': in_port('text', '', "The frame to measure in; empty: the navigator's."),
    'robot_base_frame': in_port('text', '', "The robot's frame; empty: the navigator's."),
}
_BRAKE_LIMIT_M_S2 = -10.0


@register()
class GoalReached(TreeNode):
    """
    Succeeds if the robot is near the goal.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {'goal': in_port('pose', '{goal}', 'The goal.'), **_FRAMES}

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._tolerance_m = config.context.ros.parameter(
            'goal_reached_tol', 0.25, 'How near GoalReached means, in m.'
        )

    def on_tick(self) -> NodeStatus:
        """Measure the distance to the goal."""
        frame, ros = self.input('global_frame'), self.context.ros
        robot = ros.robot_pose(frame, self.input('robot_base_frame'))
        goal = ros.pose_in(self.required('goal'), frame)
        return outcome(robot.distance_to(goal) <= self._tolerance_m)


@register()
class ArePosesNear(TreeNode):
    """Succeeds if two poses are near each other."""

    ports: ClassVar[dict[str, Port]] = {
        'ref_pose': in_port('pose', None, 'One pose.'),
        'target_pose': in_port('pose', None, 'The other one.'),
        'global_frame': in_port('text', '', "Where their frames differ; empty: the navigator's."),
        'tolerance': in_port('number', '0.5', 'How near, in m.'),
    }

    def on_tick(self) -> NodeStatus:
        """Measure the distance, in the frame of the poses if it is the same."""
        poses = [self.required(name) for name in ('ref_pose', 'target_pose')]
        frames = {pose.header.frame_id for pose in poses}
        frame = frames.pop() if len(frames) == 1 else self.input('global_frame')
        first, second = (self.context.ros.pose_in(pose, frame) for pose in poses)
        return outcome(first.distance_to(second) <= self.input('tolerance'))


@register()
class DistanceTraveled(TreeNode):
    """
    Succeeds each time the robot has travelled a distance.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'distance': in_port('number', '1.0', 'The way in m.'),
        **_FRAMES,
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._start = Pose2D(0.0, 0.0, 0.0)

    def on_tick(self) -> NodeStatus:
        """Measure the distance; the first tick starts it."""
        robot: Pose2D = self.context.ros.robot_pose(
            self.input('global_frame'), self.input('robot_base_frame')
        )
        if self.is_fresh:
            self._start = robot
            return FAILURE
        if self._start.distance_to(robot) < self.input('distance'):
            return FAILURE
        self._start = robot
        return SUCCESS


@register()
class TransformAvailable(TreeNode):
    """
    Succeeds if the transform between two frames is available, or was once.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'parent': in_port('text', REQUIRED, 'The parent frame.'),
        'child': in_port('text', REQUIRED, 'The child frame.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._was_found = False

    def on_tick(self) -> NodeStatus:
        """Look up the transform."""
        if not self._was_found:
            self._was_found = self.context.ros.can_transform(
                self.required('parent'), self.required('child')
            )
        return outcome(self._was_found)


@register()
class IsStuck(TreeNode):
    """Succeeds if the robot decelerates harder than it can by itself, as after a collision."""

    def on_tick(self) -> NodeStatus:
        """Check the acceleration."""
        return outcome(self.context.ros.acceleration_m_s2() < _BRAKE_LIMIT_M_S2)


@register()
class IsStopped(TreeNode):
    """
    Succeeds once the robot has stood still for a while; runs before that, and fails in motion.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'velocity_threshold': in_port(
            'number', '0.01', 'The speed in m/s, and the yaw rate in rad/s, of a still robot.'
        ),
        'duration_stopped': in_port('milliseconds', '1000', 'For how long, in ms.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._since_s: float | None = None

    def on_tick(self) -> NodeStatus:
        """Measure how long the robot has stood still."""
        if self.context.ros.motion() > self.input('velocity_threshold'):
            self._since_s = None
            return FAILURE
        now_s = self.context.now_s()
        if self._since_s is None or self.is_fresh:
            self._since_s = now_s
        stood_ms = (now_s - self._since_s) * 1e3
        return SUCCESS if stood_ms >= self.input('duration_stopped') else RUNNING


@register()
class IsBatteryLow(TreeNode):
    """
    Succeeds if the charge or voltage of the battery is low.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'min_battery': in_port('number', REQUIRED, 'The limit: 0 to 1, or V.'),
        'battery_topic': in_port('text', '/battery_status', 'The topic.'),
        'is_voltage': in_port('boolean', 'false', 'Whether the limit is in V.'),
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._battery = config.context.ros.latest(BatteryState, self.input('battery_topic'))

    def on_tick(self) -> NodeStatus:
        """Check the battery state; fail while none is known."""
        battery = self._battery.message
        if battery is None:
            return FAILURE
        value = battery.voltage if self.input('is_voltage') else battery.percentage
        return outcome(value <= self.input('min_battery'))


@register()
class IsBatteryCharging(TreeNode):
    """
    Succeeds while the battery is being charged.

    Parameters
    ----------
    config
        As for `TreeNode`; its context has a `RosInterface`.

    """

    ports: ClassVar[dict[str, Port]] = {
        'battery_topic': in_port('text', '/battery_status', 'The topic.')
    }

    def __init__(self, config: NodeConfig) -> None:
        super().__init__(config)
        self._battery = config.context.ros.latest(BatteryState, self.input('battery_topic'))

    def on_tick(self) -> NodeStatus:
        """Check the battery state."""
        battery = self._battery.message
        charging = BatteryState.POWER_SUPPLY_STATUS_CHARGING
        return outcome(battery is not None and battery.power_supply_status == charging)
