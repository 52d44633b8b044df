# SPDX-License-Identifier: Apache-2.0
"""The tasks that a program can give to the robot."""

# ruff: noqa: N802
from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point, PoseStamped
from nav2_msgs import action
from nav2_simple_commander._base import Base
from rclpy.duration import Duration

__all__ = ['Tasks']


class Tasks(Base):
    """Goals, waypoints, paths, behaviors and docks; each task is started, and does not block."""

    def __init__(self, node_name: str, namespace: str, **options: Any) -> None:
        super().__init__(node_name, namespace, **options)
        self.nav_to_pose_client = self._action(action.NavigateToPose, 'navigate_to_pose')
        self.nav_through_poses_client = self._action(
            action.NavigateThroughPoses, 'navigate_through_poses'
        )
        self.follow_waypoints_client = self._action(action.FollowWaypoints, 'follow_waypoints')
        self.follow_gps_waypoints_client = self._action(
            action.FollowGPSWaypoints, 'follow_gps_waypoints'
        )
        self.follow_path_client = self._action(action.FollowPath, 'follow_path')
        self.spin_client = self._action(action.Spin, 'spin')
        self.backup_client = self._action(action.BackUp, 'backup')
        self.drive_on_heading_client = self._action(action.DriveOnHeading, 'drive_on_heading')
        self.assisted_teleop_client = self._action(action.AssistedTeleop, 'assisted_teleop')
        self.docking_client = self._action(action.DockRobot, 'dock_robot')
        self.undocking_client = self._action(action.UndockRobot, 'undock_robot')

    def goToPose(self, pose: PoseStamped, behavior_tree: str = '') -> bool:
        """
        Navigate to a pose.

        Parameters
        ----------
        pose
            Where to.
        behavior_tree
            The file of the tree that says how; empty: the navigator's own.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.NavigateToPose.Goal(pose=pose, behavior_tree=behavior_tree)
        at = pose.pose.position
        return self._start(
            self.nav_to_pose_client, 'NavigateToPose', goal, f'Navigating to goal: {at.x} {at.y}'
        )

    def goThroughPoses(self, poses: list[PoseStamped], behavior_tree: str = '') -> bool:
        """Navigate through poses to the last one; see `goToPose`."""
        goal = action.NavigateThroughPoses.Goal(poses=poses, behavior_tree=behavior_tree)
        return self._start(
            self.nav_through_poses_client,
            'NavigateThroughPoses',
            goal,
            f'Navigating with {len(poses)} goals',
        )

    def followWaypoints(self, poses: list[PoseStamped]) -> bool:
        """Visit poses one after another, with a task at each; see `goToPose`."""
        goal = action.FollowWaypoints.Goal(poses=poses)
        return self._start(
            self.follow_waypoints_client,
            'FollowWaypoints',
            goal,
            f'Following {len(poses)} waypoints',
        )

    def followGpsWaypoints(self, gps_poses: list[Any]) -> bool:
        """Visit places on the earth (`geographic_msgs/GeoPose`); see `goToPose`."""
        goal = action.FollowGPSWaypoints.Goal(gps_poses=gps_poses)
        return self._start(
            self.follow_gps_waypoints_client,
            'FollowGPSWaypoints',
            goal,
            f'Following {len(gps_poses)} gps waypoints',
        )

    def followPath(
        self,
        path: Any,
        controller_id: str = '',
        goal_checker_id: str = '',
        progress_checker_id: str = '',
    ) -> bool:
        """Drive along a path with a controller; see `goToPose`."""
        goal = action.FollowPath.Goal(
            path=path,
            controller_id=controller_id,
            goal_checker_id=goal_checker_id,
            progress_checker_id=progress_checker_id,
        )
        return self._start(self.follow_path_client, 'FollowPath', goal, 'Executing path')

    def spin(
        self,
        spin_dist: float = 1.57,
        time_allowance: float = 10,
        disable_collision_checks: bool = False,
    ) -> bool:
        """Turn on the spot by rad, for at most so many s; see `goToPose`."""
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
        """Drive straight back by m, at m/s, for at most so many s; see `goToPose`."""
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
        """Drive straight ahead by m, at m/s, for at most so many s; see `goToPose`."""
        goal = action.DriveOnHeading.Goal(
            target=Point(x=float(dist)),
            speed=float(speed),
            time_allowance=_duration(time_allowance),
        )
        _set_checks(goal, disable_collision_checks)
        what = f'Drive {dist} m on heading at {speed} m/s'
        return self._start(self.drive_on_heading_client, 'DriveOnHeading', goal, what)

    def assistedTeleop(self, time_allowance: float = 30) -> bool:
        """Let a person drive, protected from collisions, for so many s; see `goToPose`."""
        goal = action.AssistedTeleop.Goal(time_allowance=_duration(time_allowance))
        return self._start(
            self.assisted_teleop_client, 'AssistedTeleop', goal, 'Running assisted teleop'
        )

    def dockRobotByPose(
        self, dock_pose: PoseStamped, dock_type: str = '', nav_to_dock: bool = True
    ) -> bool:
        """Dock at a pose, with a type of docks; see `goToPose`."""
        goal = action.DockRobot.Goal(
            use_dock_id=False,
            dock_pose=dock_pose,
            dock_type=dock_type,
            navigate_to_staging_pose=nav_to_dock,
        )
        return self._start(self.docking_client, 'DockRobot', goal, 'Docking at pose')

    def dockRobotByID(self, dock_id: str, nav_to_dock: bool = True) -> bool:
        """Dock at a dock that the server knows; see `goToPose`."""
        goal = action.DockRobot.Goal(
            use_dock_id=True, dock_id=dock_id, navigate_to_staging_pose=nav_to_dock
        )
        return self._start(self.docking_client, 'DockRobot', goal, f'Docking at dock {dock_id}')

    def undockRobot(self, dock_type: str = '') -> bool:
        """Leave the dock; see `goToPose`."""
        goal = action.UndockRobot.Goal(dock_type=dock_type)
        return self._start(self.undocking_client, 'UndockRobot', goal, 'Undocking from dock')


def _duration(seconds: float) -> Any:
    return Duration(seconds=float(seconds)).to_msg()


def _set_checks(goal: Any, disable: bool) -> None:
    """Say that collisions do not matter, where the action knows that."""
    if hasattr(goal, 'disable_collision_checks'):
        goal.disable_collision_checks = disable
