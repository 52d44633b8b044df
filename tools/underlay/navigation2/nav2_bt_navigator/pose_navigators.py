# SPDX-License-Identifier: Apache-2.0
"""The navigators for `navigate_to_pose`, also from `goal_pose`, and `navigate_through_poses`."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_behavior_tree.ros_interface import SYSTEM_DEFAULT
from nav2_bt_navigator.navigation_node import NavigationNode
from nav2_bt_navigator.navigator import Navigator
from nav2_msgs.action import NavigateThroughPoses, NavigateToPose
from rclpy.action import ActionClient

__all__ = ['NavigateThroughPosesNavigator', 'NavigateToPoseNavigator']


class NavigateToPoseNavigator(Navigator):
    """
    Navigator that offers `navigate_to_pose`, and starts it for each pose on `goal_pose`.

    Parameters
    ----------
    node, name
        As for `Navigator`.

    Raises
    ------
    ConfigurationError
        The default behavior tree is invalid.

    """

    action = NavigateToPose
    default_file = 'navigate_to_pose_w_replanning_and_recovery.xml'
    file_parameter = 'default_nav_to_pose_bt_xml'
    first_code = 9000

    def __init__(self, node: NavigationNode, name: str) -> None:
        super().__init__(node, name)
        self._client = ActionClient(node, NavigateToPose, name)
        node.create_subscription(PoseStamped, 'goal_pose', self._go, SYSTEM_DEFAULT)

    def _go(self, pose: PoseStamped) -> None:
        self._client.send_goal_async(NavigateToPose.Goal(pose=pose))

    def close(self) -> None:
        """Halt the running tree, and destroy the client."""
        super().close()
        self._client.destroy()

    def goals_of(self, goal: Any) -> list[PoseStamped]:
        """
        Return the pose of a goal, as a list of one.

        Parameters
        ----------
        goal
            A goal of `nav2_msgs/NavigateToPose`.

        """
        return [goal.pose]

    def write_goal(self, blackboard: Any, poses: list[PoseStamped]) -> None:
        """
        Write the pose to the entry `goal_blackboard_id`.

        Parameters
        ----------
        blackboard, poses
            As for `Navigator.write_goal`; only the first pose is used.

        """
        blackboard.set(self.node.settings.current.goal_blackboard_id, poses[0])


class NavigateThroughPosesNavigator(Navigator):
    """Navigator that offers `navigate_through_poses`."""

    action = NavigateThroughPoses
    default_file = 'navigate_through_poses_w_replanning_and_recovery.xml'
    file_parameter = 'default_nav_through_poses_bt_xml'
    first_code = 9100

    def goals_of(self, goal: Any) -> list[PoseStamped]:
        """
        Return the poses of a goal.

        Parameters
        ----------
        goal
            A goal of `nav2_msgs/NavigateThroughPoses`.

        """
        return list(goal.poses)

    def write_goal(self, blackboard: Any, poses: list[PoseStamped]) -> None:
        """
        Write the poses to the entry `goals_blackboard_id`.

        Parameters
        ----------
        blackboard, poses
            As for `Navigator.write_goal`.

        """
        blackboard.set(self.node.settings.current.goals_blackboard_id, poses)

    def fill_feedback(self, feedback: Any, blackboard: Any) -> None:
        """
        Fill in the number of remaining poses.

        Parameters
        ----------
        feedback, blackboard
            As for `Navigator.fill_feedback`.

        """
        goals = blackboard.get(self.node.settings.current.goals_blackboard_id, [])
        feedback.number_of_poses_remaining = len(goals)
