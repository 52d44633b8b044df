# SPDX-License-Identifier: Apache-2.0
"""Goal tool: set a navigation goal, shared with the navigation panel."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_rviz_plugins.session import NavigationSession, session_of
from robot_console.namespaces import NAMESPACE
from rviz_common.context import Context
from rviz_common.tool import Point, Tool
from rviz_default_plugins.tools.publishing import heading, PoseArrow

__all__ = ['GoalTool']


class GoalTool(Tool):
    """
    Sends the robot to a pose, or adds the pose to the waypoints while these are collected.

    Parameters
    ----------
    context
        The context: node, frames and scene.
    root
        The scene path below which the tool draws.
    given
        The properties from the configuration file, such as `Namespace`.

    """

    CLASS = 'nav2_rviz_plugins/GoalTool'
    NAME = 'Nav2 Goal'
    HINT = 'Press on the ground where it is to go, drag to where it is to look, and release.'
    PROPERTIES = (NAMESPACE,)

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
        Handle a click as a goal pose that faces along x.

        Parameters
        ----------
        point
            The position (3,) in m, in the fixed frame.

        Returns
        -------
        bool
            Whether the tool is done: not while waypoints are collected.

        """
        return self._give(point, 0.0)

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """
        Draw the goal pose while it is dragged, and use it on release.

        Parameters
        ----------
        start, end
            The position (3,), and a point (3,) that it faces, in m, in the fixed frame.
        is_over
            Whether the pointer was released.

        Returns
        -------
        bool
            Whether the tool is done: after the end, unless waypoints are collected.

        """
        yaw = heading(start, end)
        self._arrow.show(start, yaw)
        if not is_over:
            return False
        self._arrow.hide()
        return self._give(start, yaw)

    def _give(self, point: Point, yaw: float) -> bool:
        """Submit a pose; return whether the tool is done: not while waypoints are collected."""
        try:
            session = self._session()
        except ImportError as error:
            self._say(str(error))
            return True
        pose = PoseStamped()
        pose.header.stamp = self.context.node.get_clock().now().to_msg()
        pose.header.frame_id = self.context.frames.fixed_frame
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = point
        pose.pose.orientation.z, pose.pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
        session.take_pose(pose)
        return not session.collects

    def _session(self) -> NavigationSession:
        return session_of(self.context.node, self.values['Namespace'] or None)

    def _say(self, sentence: str) -> None:
        """Show why the tool has no effect."""
        if self.context.visualizer is not None:
            self.context.visualizer.notify(self.NAME, sentence)
        else:
            self.context.node.get_logger().error(f'{self.NAME}: {sentence}')
