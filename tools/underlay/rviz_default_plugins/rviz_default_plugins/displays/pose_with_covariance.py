# SPDX-License-Identifier: Apache-2.0
"""An arrow or axes at a pose, with the covariance of its position."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped
from rviz_common.canvas import Canvas
from rviz_common.message_display import MessageDisplay
from rviz_common.properties import topic_properties
from rviz_default_plugins.drawing.pose_shape import (
    add_covariance,
    add_pose,
    COVARIANCE,
    pose_shape_properties,
)

__all__ = ['PoseWithCovariance']


class PoseWithCovariance(MessageDisplay):
    """The newest pose of a topic, with an ellipsoid around where it may be."""

    CLASS = 'rviz_default_plugins/PoseWithCovariance'
    MESSAGE = PoseWithCovarianceStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PoseWithCovarianceStamped', '/initialpose'),
        *pose_shape_properties('Shape'),
        *COVARIANCE,
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._canvas = Canvas(self.context.scene, self.root)
        super().start()

    def show(self, message: Any) -> None:
        """
        Draw the pose, and the ellipsoid of its covariance.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
        with self._canvas.anew():
            add_covariance(self._canvas, message.pose, self.values)
            add_pose(self._canvas, message.pose.pose, self.values, 'Shape')
