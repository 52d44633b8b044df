# SPDX-License-Identifier: Apache-2.0
"""The navigator for `navigate_through_poses`."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_bt_navigator.navigator import Navigator
from nav2_msgs.action import NavigateThroughPoses

__all__ = ['NavigateThroughPosesNavigator']


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
