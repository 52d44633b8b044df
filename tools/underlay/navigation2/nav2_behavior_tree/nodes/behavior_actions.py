# SPDX-License-Identifier: Apache-2.0
"""Nodes that run behaviors, dock the robot, or cancel the goals of other nodes."""

from __future__ import annotations

from typing import Any, ClassVar

from action_msgs.srv import CancelGoal
from nav2_behavior_tree.action_node import (
    ActionNode,
    BASIC_PORTS,
    count_recovery,
    ERROR_PORTS,
    ServiceNode,
)
from nav2_behavior_tree.node import NodeConfig
from nav2_behavior_tree.ports import Binding, in_port, out_port, Port
from nav2_behavior_tree.registry import register
from nav2_behavior_tree.status import NodeStatus
from nav2_msgs import action
from rclpy.duration import Duration

__all__ = [
    'AssistedTeleop',
    'BackUp',
    'DockRobot',
    'DriveOnHeading',
    'Spin',
    'UndockRobot',
    'Wait',
]

_ALLOWANCE: dict[str, Port] = {
    'time_allowance': in_port('number', '10.0', 'How long it may take, in s.'),
}
_COLLISIONS: dict[str, Port] = {
    'disable_collision_checks': in_port('boolean', 'false', 'Whether to go without looking.'),
}


def _duration(seconds: float) -> Any:
    return Duration(seconds=max(float(seconds), 0.0)).to_msg()


class _Behavior(ActionNode):
    """Base class of behavior nodes, which count as recoveries unless `is_recovery` is false."""

    def make_goal(self) -> Any:
        """Make the goal of the behavior, and count the recovery."""
        if self.input('is_recovery') if 'is_recovery' in self.ports else True:
            count_recovery(self)
        goal = self.action.Goal()
        if 'time_allowance' in self.ports:
            goal.time_allowance = _duration(self.input('time_allowance'))
        if hasattr(goal, 'disable_collision_checks'):
            goal.disable_collision_checks = self.input('disable_collision_checks')
        self.fill(goal)
        return goal

    def fill(self, goal: Any) -> None:
        """Fill in the fields of the goal."""


@register()
class Spin(_Behavior):
    """Rotates the robot in place."""

    action, server, purpose = action.Spin, 'spin', 'The robot could not turn'
    ports: ClassVar[dict[str, Port]] = {
        'spin_dist': in_port('number', '1.57', 'By how much, in rad.'),
        'is_recovery': in_port('boolean', 'true', 'Whether it counts as a recovery.'),
        **_ALLOWANCE,
        **_COLLISIONS,
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def fill(self, goal: Any) -> None:
        """
        Fill in the angle.

        Parameters
        ----------
        goal
            The goal of the action `Spin`, modified in place.

        """
        goal.target_yaw = float(self.input('spin_dist'))


@register()
class BackUp(_Behavior):
    """Drives straight backward."""

    action, server, purpose = action.BackUp, 'backup', 'The robot could not back up'
    ports: ClassVar[dict[str, Port]] = {
        'backup_dist': in_port('number', '0.15', 'How far, in m.'),
        'backup_speed': in_port('number', '0.025', 'How fast, in m/s.'),
        **_ALLOWANCE,
        **_COLLISIONS,
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def fill(self, goal: Any) -> None:
        """
        Fill in the distance and the speed.

        Parameters
        ----------
        goal
            The goal of the action `BackUp`, modified in place.

        """
        goal.target.x = float(self.input('backup_dist'))
        goal.speed = float(self.input('backup_speed'))


@register()
class DriveOnHeading(_Behavior):
    """Drives straight forward."""

    action, server = action.DriveOnHeading, 'drive_on_heading'
    purpose = 'The robot could not drive ahead'
    ports: ClassVar[dict[str, Port]] = {
        'dist_to_travel': in_port('number', '0.15', 'How far, in m.'),
        'speed': in_port('number', '0.025', 'How fast, in m/s.'),
        'is_recovery': in_port('boolean', 'false', 'Whether it counts as a recovery.'),
        **_ALLOWANCE,
        **_COLLISIONS,
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def fill(self, goal: Any) -> None:
        """
        Fill in the distance and the speed.

        Parameters
        ----------
        goal
            The goal of the action `DriveOnHeading`, modified in place.

        """
        goal.target.x = float(self.input('dist_to_travel'))
        goal.speed = float(self.input('speed'))


@register()
class AssistedTeleop(_Behavior):
    """Assisted teleoperation: an operator drives the robot, with collision avoidance."""

    action, server = action.AssistedTeleop, 'assisted_teleop'
    purpose = 'Assisted teleoperation ended'
    ports: ClassVar[dict[str, Port]] = {
        'is_recovery': in_port('boolean', 'false', 'Whether it counts as a recovery.'),
        **_ALLOWANCE,
        **BASIC_PORTS,
        **ERROR_PORTS,
    }


@register()
class Wait(_Behavior):
    """Waits for a duration."""

    action, server, purpose = action.Wait, 'wait', 'The robot could not wait'
    ports: ClassVar[dict[str, Port]] = {
        'wait_duration': in_port('number', '1.0', 'For how long, in s.'),
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def fill(self, goal: Any) -> None:
        """
        Fill in the duration.

        Parameters
        ----------
        goal
            The goal of the action `Wait`, modified in place.

        """
        goal.time = _duration(abs(self.input('wait_duration')))


@register()
class DockRobot(ActionNode):
    """Docks the robot."""

    action, server, purpose = action.DockRobot, 'dock_robot', 'The robot could not be docked'
    ports: ClassVar[dict[str, Port]] = {
        'use_dock_id': in_port('boolean', 'true', 'Whether the dock is known by its ID.'),
        'dock_id': in_port('text', '', 'The ID.'),
        'dock_pose': in_port('pose', None, 'The pose of a dock that is not known.'),
        'dock_type': in_port('text', '', 'The type of such a dock.'),
        'max_staging_time': in_port('number', '1000.0', 'How long the way may take, in s.'),
        'navigate_to_staging_pose': in_port('boolean', 'true', 'Whether to drive there first.'),
        'success': out_port('boolean', 'Whether it is docked.'),
        'num_retries': out_port('natural', 'How often it tried again.'),
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def make_goal(self) -> Any:
        """Make the goal for the docking server."""
        goal = action.DockRobot.Goal(
            use_dock_id=self.input('use_dock_id'),
            dock_id=self.input('dock_id') or '',
            dock_type=self.input('dock_type') or '',
            max_staging_time=float(self.input('max_staging_time')),
            navigate_to_staging_pose=self.input('navigate_to_staging_pose'),
        )
        if not goal.use_dock_id:
            goal.dock_pose = self.required('dock_pose')
        return goal

    def on_success(self, result: Any) -> NodeStatus:
        """
        Write whether the robot is docked, and after how many retries, to the output ports.

        Parameters
        ----------
        result
            The result of the action `DockRobot`.

        Returns
        -------
        NodeStatus
            SUCCESS, even if the result reports a failure.

        """
        self.output('success', result.success)
        self.output('num_retries', result.num_retries)
        return NodeStatus.SUCCESS


@register()
class UndockRobot(ActionNode):
    """Undocks the robot."""

    action, server, purpose = action.UndockRobot, 'undock_robot', 'The robot could not be undocked'
    ports: ClassVar[dict[str, Port]] = {
        'dock_type': in_port('text', '', 'The type of the dock; empty: the one it knows.'),
        'max_undocking_time': in_port('number', '30.0', 'How long it may take, in s.'),
        'success': out_port('boolean', 'Whether it is out.'),
        **BASIC_PORTS,
        **ERROR_PORTS,
    }

    def make_goal(self) -> Any:
        """Make the goal for the docking server."""
        return action.UndockRobot.Goal(
            dock_type=self.input('dock_type') or '',
            max_undocking_time=float(self.input('max_undocking_time')),
        )

    def on_success(self, result: Any) -> NodeStatus:
        """
        Write whether the robot has left its dock to the output port.

        Parameters
        ----------
        result
            The result of the action `UndockRobot`.

        Returns
        -------
        NodeStatus
            SUCCESS, even if the result reports a failure.

        """
        self.output('success', result.success)
        return NodeStatus.SUCCESS


class _Cancel(ServiceNode):
    """Cancels all goals of an action; also succeeds if there were none."""

    service = CancelGoal
    server: ClassVar[str]
    ports: ClassVar[dict[str, Port]] = BASIC_PORTS

    def __init__(self, config: NodeConfig) -> None:
        server = config.bindings['server_name'].value or self.server
        config.bindings['service_name'] = Binding(None, f'{server}/_action/cancel_goal', 'text')
        super().__init__(config)


for _name, _server in (
    ('CancelControl', 'follow_path'),
    ('CancelSpin', 'spin'),
    ('CancelBackUp', 'backup'),
    ('CancelDriveOnHeading', 'drive_on_heading'),
    ('CancelAssistedTeleop', 'assisted_teleop'),
    ('CancelWait', 'wait'),
):
    register()(type(_name, (_Cancel,), {'__doc__': _Cancel.__doc__, 'server': _server}))
