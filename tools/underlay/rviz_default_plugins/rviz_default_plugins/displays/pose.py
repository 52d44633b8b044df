# SPDX-License-Identifier: Apache-2.0
"""An arrow or axes at a pose."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PoseStamped
from rviz_common.canvas import Canvas
from rviz_common.message_display import MessageDisplay
from rviz_common.properties import topic_properties
from rviz_default_plugins.drawing.pose_shape import add_pose, pose_shape_properties

__all__ = ['Pose']


class Pose(MessageDisplay):
    """The newest pose of a topic."""

    CLASS = 'rviz_default_plugins/Pose'
    MESSAGE = PoseStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PoseStamped', '/pose'),
        *pose_shape_properties('Shape'),
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._canvas = Canvas(self.context.scene, self.root)
        super().start()

    def show(self, message: Any) -> None:
        """
        Draw the arrow or the axes.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
        with self._canvas.anew():
            add_pose(self._canvas, message.pose, self.values, 'Shape')
