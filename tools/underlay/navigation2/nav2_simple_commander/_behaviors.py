# SPDX-License-Identifier: Apache-2.0
"""The asynchronous tasks that take the robot to no goal: behaviors, teleoperation and docking."""

# ruff: noqa: N802
from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point, PoseStamped
from nav2_msgs import action
from nav2_simple_commander._base import Base
from rclpy.duration import Duration

__all__ = ['Behaviors']


class Behaviors(Base):
    """
    Node that starts behaviors, assisted teleoperation and docking without blocking.

    Parameters
    ----------
    node_name, namespace
        The name of the node.
    **options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str, namespace: str, **options: Any) -> None:
        super().__init__(node_name, namespace, **options)
        self.spin_client = self._action(action.Spin, 'spin')
        self.backup_client = self._action(action.BackUp, 'backup')
        self.drive_on_heading_client = self._action(action.DriveOnHeading, 'drive_on_heading')
        self.assisted_teleop_client = self._action(action.AssistedTeleop, 'assisted_teleop')
        self.docking_client = self._action(action.DockRobot, 'dock_robot')
        self.undocking_client = self._action(action.UndockRobot, 'undock_robot')

    def spin(
        self,
        spin_dist: float = 1.57,
        time_allowance: float = 10,
        disable_collision_checks: bool = False,
    ) -> bool:
        """
        Rotate in place.

        Parameters
        ----------
        spin_dist
            The angle in rad, positive counter-clockwise.
        time_allowance
            The time limit in s; 0 for no limit.
        disable_collision_checks
            Whether to rotate without collision checks; no effect if the action has no such field.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.Spin.Goal(
            target_yaw=float(spin_dist), time_allowance=_duration(time_allowance)
        )
        _set_checks(goal, disable_collision_checks)
        return self._start(self.spin_client, 'Spin', goal, f'Spinning to angle {spin_dist}')

    def backup(
        self,
        backup_dist: float = 0.15,
        backup_speed: float = 0.025,
        time_allowance: float = 10,
        disable_collision_checks: bool = False,
    ) -> bool:
        """
        Drive straight backward.

        Parameters
        ----------
        backup_dist, backup_speed
            The distance in m and the speed in m/s; the signs are ignored.
        time_allowance
            The time limit in s; 0 for no limit.
        disable_collision_checks
            Whether to drive without collision checks; no effect if the action has no such field.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.BackUp.Goal(
            target=Point(x=float(backup_dist)),
            speed=float(backup_speed),
            time_allowance=_duration(time_allowance),
        )
        _set_checks(goal, disable_collision_checks)
        what = f'Backing up {backup_dist} m at {backup_speed} m/s'
        return self._start(self.backup_client, 'Backup', goal, what)

    def driveOnHeading(
        self,
        dist: float = 0.15,
        speed: float = 0.025,
        time_allowance: float = 10,
        disable_collision_checks: bool = False,
    ) -> bool:
        """
        Drive straight forward.

        Parameters
        ----------
        dist, speed
            The distance in m and the speed in m/s; both negative to drive backward.
        time_allowance
            The time limit in s; 0 for no limit.
        disable_collision_checks
            Whether to drive without collision checks; no effect if the action has no such field.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.DriveOnHeading.Goal(
            target=Point(x=float(dist)),
            speed=float(speed),
            time_allowance=_duration(time_allowance),
        )
        _set_checks(goal, disable_collision_checks)
        what = f'Drive {dist} m on heading at {speed} m/s'
        return self._start(self.drive_on_heading_client, 'DriveOnHeading', goal, what)

    def assistedTeleop(self, time_allowance: float = 30) -> bool:
        """
        Start assisted teleoperation: an operator drives the robot, with collision avoidance.

        Parameters
        ----------
        time_allowance
            The time in s after which the task fails; 0 for no limit.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.AssistedTeleop.Goal(time_allowance=_duration(time_allowance))
        return self._start(
            self.assisted_teleop_client, 'AssistedTeleop', goal, 'Running assisted teleop'
        )

    def dockRobotByPose(
        self, dock_pose: PoseStamped, dock_type: str = '', nav_to_dock: bool = True
    ) -> bool:
        """
        Dock at the pose of a dock.

        Parameters
        ----------
        dock_pose, dock_type
            The pose of the dock, and the name of its type.
        nav_to_dock
            Whether to navigate to the staging pose first; otherwise docking starts immediately.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.DockRobot.Goal(
            use_dock_id=False,
            dock_pose=dock_pose,
            dock_type=dock_type,
            navigate_to_staging_pose=nav_to_dock,
        )
        return self._start(self.docking_client, 'DockRobot', goal, 'Docking at pose')

    def dockRobotByID(self, dock_id: str, nav_to_dock: bool = True) -> bool:
        """
        Dock at a dock from the database of the docking server.

        Parameters
        ----------
        dock_id
            The name of the dock.
        nav_to_dock
            Whether to navigate to the staging pose first; otherwise docking starts immediately.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.DockRobot.Goal(
            use_dock_id=True, dock_id=dock_id, navigate_to_staging_pose=nav_to_dock
        )
        return self._start(self.docking_client, 'DockRobot', goal, f'Docking at dock {dock_id}')

    def undockRobot(self, dock_type: str = '') -> bool:
        """
        Undock the robot.

        Parameters
        ----------
        dock_type
            The name of the dock's type; empty for that of the current dock.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.UndockRobot.Goal(dock_type=dock_type)
        return self._start(self.undocking_client, 'UndockRobot', goal, 'Undocking from dock')


def _duration(seconds: float) -> Any:
    return Duration(seconds=float(seconds)).to_msg()


def _set_checks(goal: Any, disable: bool) -> None:
    """Set `disable_collision_checks` of a goal, if the action has that field."""
    if hasattr(goal, 'disable_collision_checks'):
        goal.disable_collision_checks = disable
