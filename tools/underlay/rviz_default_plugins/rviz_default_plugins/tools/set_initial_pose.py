# SPDX-License-Identifier: Apache-2.0
"""The tool that publishes an initial pose estimate."""

from __future__ import annotations

from geometry_msgs.msg import PoseWithCovarianceStamped
from rviz_common.properties import Number, topic_properties
from rviz_common.tool import Point
from rviz_default_plugins.tools.pose_tool import PoseTool

__all__ = ['SetInitialPose']

COVARIANCES = {'Covariance x': 0, 'Covariance y': 7, 'Covariance yaw': 35}
"""The index of each in the 6 x 6 covariance matrix."""


class SetInitialPose(PoseTool):
    """Tool that publishes an initial pose estimate of the robot, with its covariance."""

    CLASS = 'rviz_default_plugins/SetInitialPose'
    NAME = '2D Pose Estimate'
    MESSAGE = PoseWithCovarianceStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PoseWithCovarianceStamped', 'initialpose'),
        Number('Covariance x', 0.5**2, 'The variance along x, in square metres.', 0.0),
        Number('Covariance y', 0.5**2, 'The variance along y, in square metres.', 0.0),
        Number('Covariance yaw', 0.06853891909122467, 'That of the angle, in rad².', 0.0),
    )

    def message(self, point: Point, yaw: float) -> PoseWithCovarianceStamped:
        """
        Make the pose estimate, with the covariance of the properties.

        Parameters
        ----------
        point, yaw
            As for `PoseTool.message`.

        """
        message = self.stamped()
        self.fill(message.pose.pose, point, yaw)
        for path, index in COVARIANCES.items():
            message.pose.covariance[index] = self.values[path]
        return message
