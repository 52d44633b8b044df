# SPDX-License-Identifier: Apache-2.0
"""The tools that publish what is clicked: a point, or a pose as goal or initial estimate."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any, ClassVar

from geometry_msgs.msg import PointStamped, Pose, PoseStamped, PoseWithCovarianceStamped
from rviz_common.context import Context
from rviz_common.properties import Flag, Number, qos_of, topic_properties
from rviz_common.tool import Point, Tool

__all__ = ['PoseArrow', 'PublishPoint', 'Publishing', 'SetGoal', 'SetInitialPose', 'heading']


class Publishing(Tool):
    """Tool that publishes messages to the topic of its properties."""

    MESSAGE: ClassVar[type]
    _publisher: Any = None

    def begin(self) -> None:
        """Advertise the topic early, so that subscribers are discovered before the first use."""
        topic = self.values['Topic/Value']
        try:
            self._publisher = self.context.node.create_publisher(
                self.MESSAGE, topic, qos_of(self.values)
            )
        except Exception as error:  # rclpy has no single exception for invalid names
            self.context.node.get_logger().error(
                f"Tool '{self.NAME}' cannot publish to '{topic}': {error}"
            )

    def close(self) -> None:
        """Destroy the publisher."""
        if self._publisher is not None:
            self.context.node.destroy_publisher(self._publisher)
            self._publisher = None

    def stamped(self) -> Any:
        """Return a message stamped with the current time, in the fixed frame."""
        message = self.MESSAGE()
        message.header.stamp = self.context.node.get_clock().now().to_msg()
        message.header.frame_id = self.context.frames.fixed_frame
        return message

    def publish(self, message: Any) -> None:
        """
        Publish a message, and log the number of subscribers.

        Parameters
        ----------
        message
            A message of the type `MESSAGE`.

        """
        logger = self.context.node.get_logger()
        if self._publisher is None:
            logger.error(f"Tool '{self.NAME}' has no topic to publish to.")
            return
        self._publisher.publish(message)
        count = self._publisher.get_subscription_count()
        heard = '1 subscriber' if count == 1 else f'{count or "no"} subscribers'
        logger.info(f'{self.NAME}: published to {self._publisher.topic_name}, which has {heard}.')


class PublishPoint(Publishing):
    """Tool that publishes the clicked point on the ground."""

    CLASS = 'rviz_default_plugins/PublishPoint'
    NAME = 'Publish Point'
    HINT = 'Click on the ground.'
    MESSAGE = PointStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PointStamped', 'clicked_point'),
        Flag('Single click', True, 'Whether the tool is deselected after one click.'),
    )

    def click(self, point: Point) -> bool:
        """
        Publish the point.

        Parameters
        ----------
        point
            As for `Tool.click`.

        """
        message = self.stamped()
        message.point.x, message.point.y, message.point.z = point
        self.publish(message)
        return bool(self.values['Single click'])

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """
        Publish the end of the drag, as if it were clicked.

        Parameters
        ----------
        start, end, is_over
            As for `Tool.drag`.

        """
        return self.click(end) if is_over else False


COVARIANCES = {'Covariance x': 0, 'Covariance y': 7, 'Covariance yaw': 35}
"""The index of each in the 6 x 6 covariance matrix."""

GREEN = (40, 220, 40)
LONG_M, SHORT_M = 0.7, 0.05


class PoseTool(Publishing):
    """
    Tool that publishes a pose: press at its position, drag to its heading, and release.

    Parameters
    ----------
    context, root, given
        As for `Tool`.

    """

    HINT = (
        'Press on the ground at the position, drag in the direction it should face, and release.'
    )

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


class SetInitialPose(PoseTool):
    """Tool that publishes an initial pose estimate of the robot, with its covariance."""

    CLASS = 'rviz_default_plugins/SetInitialPose'
    NAME = '2D Pose Estimate'
    MESSAGE = PoseWithCovarianceStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PoseWithCovarianceStamped', 'initialpose'),
        Number('Covariance x', 0.5**2, 'The variance along x, in square metres.', 0.0),
        Number('Covariance y', 0.5**2, 'The variance along y, in square metres.', 0.0),
        Number('Covariance yaw', 0.06853891909122467, 'The variance of the angle, in rad².', 0.0),
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


def heading(start: Point, end: Point) -> float:
    """
    Compute the yaw of the direction from one point to another.

    Parameters
    ----------
    start, end
        The points, in m.

    Returns
    -------
    float
        The angle from the x axis, in rad, from -pi to pi.

    """
    return math.atan2(end[1] - start[1], end[0] - start[0])


class PoseArrow:
    """
    An arrow on the ground, at a point and in a direction.

    Parameters
    ----------
    context
        The context, with the scene.
    root
        The path of the arrow in the scene; no node exists before `show`.

    """

    def __init__(self, context: Context, root: str) -> None:
        self._scene = context.scene
        self._root = root
        self._arrow: Any = None

    def show(self, start: Point, yaw: float) -> None:
        """
        Draw the arrow, replacing the previous one.

        Parameters
        ----------
        start
            The position of its tail, in m in the fixed frame.
        yaw
            Its direction, in rad from the x axis.

        """
        import numpy as np

        tip = (start[0] + LONG_M * math.cos(yaw), start[1] + LONG_M * math.sin(yaw), SHORT_M)
        points = np.array([[(*start[:2], SHORT_M), tip]], np.float32)
        if self._arrow is None:
            self._arrow = self._scene.add_arrows(
                self._root, points, GREEN, shaft_radius=0.04, head_radius=0.1, head_length=0.25
            )
        self._arrow.points = points
        self._arrow.visible = True

    def hide(self) -> None:
        """Hide the arrow."""
        if self._arrow is not None:
            self._arrow.visible = False
