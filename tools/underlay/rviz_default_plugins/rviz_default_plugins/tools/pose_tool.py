# SPDX-License-Identifier: Apache-2.0
"""The base class of tools that publish a pose on the ground."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any

from geometry_msgs.msg import Pose
from rviz_common.context import Context
from rviz_common.tool import Point
from rviz_default_plugins.tools.pose_arrow import heading, PoseArrow
from rviz_default_plugins.tools.publishing import Publishing

__all__ = ['PoseTool']


class PoseTool(Publishing):
    """
    Tool that publishes a pose: press at its position, drag to its heading, and release.

    Parameters
    ----------
    context, root, given
        As for `Tool`.

    """

    HINT = 'Press on the ground where it is to be, drag to where it is to look, and release.'

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__(context, root, given)
        self._arrow = PoseArrow(context, root)

    def lay_down(self) -> None:
        """Deactivate the tool."""
        self._arrow.hide()

    def click(self, point: Point) -> bool:
        """
        Publish a pose that faces along the x axis.

        Parameters
        ----------
        point
            As for `Tool.click`.

        """
        self.publish(self.message(point, 0.0))
        return True

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """
        Show the pose as an arrow, and publish it when the button is released.

        Parameters
        ----------
        start, end, is_over
            As for `Tool.drag`.

        """
        yaw = heading(start, end)
        self._arrow.show(start, yaw)
        if is_over:
            self.publish(self.message(start, yaw))
        return is_over

    def message(self, point: Point, yaw: float) -> Any:
        """
        Make the message to be published.

        Parameters
        ----------
        point
            The position, in m in the fixed frame.
        yaw
            The heading, in rad from the x axis.

        """
        raise NotImplementedError

    def fill(self, pose: Pose, point: Point, yaw: float) -> None:
        """
        Set the pose in a message.

        Parameters
        ----------
        pose
            The pose to set, with the identity rotation.
        point, yaw
            As for `message`.

        """
        pose.position.x, pose.position.y, pose.position.z = point
        pose.orientation.z, pose.orientation.w = math.sin(yaw / 2.0), math.cos(yaw / 2.0)
