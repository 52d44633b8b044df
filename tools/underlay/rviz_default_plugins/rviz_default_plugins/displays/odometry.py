# SPDX-License-Identifier: Apache-2.0
"""The display of odometry."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any

from nav_msgs.msg import Odometry as OdometryMessage
from rviz_common.canvas import Canvas
from rviz_common.context import Context
from rviz_common.frames import Pose
from rviz_common.history_display import HistoryDisplay
from rviz_common.properties import Number, topic_properties, Whole
from rviz_default_plugins.decoding.geometry import position, rotation
from rviz_default_plugins.displays.pose import (
    add_covariance,
    add_pose,
    COVARIANCE,
    pose_shape_properties,
)

__all__ = ['Odometry']

MOST = 1000
"""The maximum number of poses when the file sets no limit."""


class Odometry(HistoryDisplay):
    """
    The last poses of a robot that are not too close to each other.

    Parameters
    ----------
    context, root, given
        As for `Display`.

    """

    CLASS = 'rviz_default_plugins/Odometry'
    MESSAGE = OdometryMessage
    PROPERTIES = (
        *topic_properties('nav_msgs/msg/Odometry', '/odom'),
        Number('Position Tolerance', 0.1, 'Minimum distance between shown poses, in metres.', 0.0),
        Number('Angle Tolerance', 0.1, 'Minimum rotation between shown poses, in radians.', 0.0),
        Whole('Keep', 100, f'Number of poses shown; 0: {MOST}.', 0),
        *pose_shape_properties('Shape/Value', 'Shape/'),
        *COVARIANCE,
    )

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__(context, root, given)
        self._last: Any = None

    def start(self) -> None:
        """Subscribe to the topic."""
        self._last = None
        super().start()

    def keep(self) -> int:
        """Return the number of poses shown at once."""
        return min(int(self.values['Keep']) or MOST, MOST)

    def take(self, message: Any) -> None:
        """
        Queue a message until its transform is available, unless the robot has hardly moved.

        Parameters
        ----------
        message
            As for `HistoryDisplay.take`; one with an invalid pose is left out.

        """
        pose = message.pose.pose
        try:
            position(pose.position)
            rotation(pose.orientation)
        except ValueError as error:
            self.say_left_out(error)
            return
        if self._last is None or self._is_far(pose, self._last):
            self._last = pose
            super().take(message)

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw a pose, and the ellipsoid of its covariance.

        Parameters
        ----------
        canvas, message, pose
            As for `HistoryDisplay.draw`.

        """
        add_covariance(canvas, message.pose, self.values)
        add_pose(canvas, message.pose.pose, self.values, 'Shape/Value', 'Shape/')

    def _is_far(self, pose: Any, last: Any) -> bool:
        here, there = position(pose.position), position(last.position)
        turn, before = rotation(pose.orientation), rotation(last.orientation)
        likeness = min(1.0, abs(sum(a * b for a, b in zip(turn, before))))
        return bool(
            math.dist(here, there) >= self.values['Position Tolerance']
            or 2.0 * math.acos(likeness) >= self.values['Angle Tolerance']
        )
