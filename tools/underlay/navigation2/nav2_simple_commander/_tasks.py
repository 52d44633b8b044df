# SPDX-License-Identifier: Apache-2.0
"""The asynchronous tasks that lead somewhere: goals, waypoints and paths."""

# ruff: noqa: N802
from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_msgs import action
from nav2_simple_commander._behaviors import Behaviors

__all__ = ['Tasks']


class Tasks(Behaviors):
    """
    Node that starts goals, waypoints, paths and behaviors without blocking.

    Parameters
    ----------
    node_name, namespace
        The name of the node.
    **options
        Further keyword arguments of `rclpy.node.Node`.

    """

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

    def goToPose(self, pose: PoseStamped, behavior_tree: str = '') -> bool:
        """
        Navigate to a pose.

        Parameters
        ----------
        pose
            The goal pose.
        behavior_tree
            The file of the behavior tree; empty for the navigator's default.

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
        """
        Navigate through poses to the last one.

        Parameters
        ----------
        poses
            The poses to pass.
        behavior_tree
            The file of the behavior tree; empty for the navigator's default.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.NavigateThroughPoses.Goal(poses=poses, behavior_tree=behavior_tree)
        return self._start(
            self.nav_through_poses_client,
            'NavigateThroughPoses',
            goal,
            f'Navigating with {len(poses)} goals',
        )

    def followWaypoints(self, poses: list[PoseStamped]) -> bool:
        """
        Visit waypoints one after another, with a task at each.

        Parameters
        ----------
        poses
            The waypoints.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.FollowWaypoints.Goal(poses=poses)
        return self._start(
            self.follow_waypoints_client,
            'FollowWaypoints',
            goal,
            f'Following {len(poses)} waypoints',
        )

    def followGpsWaypoints(self, gps_poses: list[Any]) -> bool:
        """
        Visit GPS waypoints one after another, with a task at each.

        Parameters
        ----------
        gps_poses
            The waypoints, each a `geographic_msgs/GeoPose`.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
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
        """
        Follow a path with a controller, without planning.

        Parameters
        ----------
        path
            The `nav_msgs/Path`.
        controller_id, goal_checker_id, progress_checker_id
            The plugins of the controller server; empty if there is only one.

        Returns
        -------
        bool
            Whether the goal was accepted.

        """
        goal = action.FollowPath.Goal(
            path=path,
            controller_id=controller_id,
            goal_checker_id=goal_checker_id,
            progress_checker_id=progress_checker_id,
        )
        return self._start(self.follow_path_client, 'FollowPath', goal, 'Executing path')
