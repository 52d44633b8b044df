# SPDX-License-Identifier: Apache-2.0
"""The tool that publishes a goal pose."""

from __future__ import annotations

from geometry_msgs.msg import PoseStamped
from rviz_common.properties import topic_properties
from rviz_common.tool import Point
from rviz_default_plugins.tools.pose_tool import PoseTool

__all__ = ['SetGoal']


class SetGoal(PoseTool):
    """Tool that publishes a goal pose for the robot."""

    CLASS = 'rviz_default_plugins/SetGoal'
    NAME = '2D Goal Pose'
    MESSAGE = PoseStamped
    PROPERTIES = topic_properties('geometry_msgs/msg/PoseStamped', 'goal_pose')

    def message(self, point: Point, yaw: float) -> PoseStamped:
        """
        Make the goal pose.

        Parameters
        ----------
        point, yaw
            As for `PoseTool.message`.

        """
        message = self.stamped()
        self.fill(message.pose, point, yaw)
        return message
