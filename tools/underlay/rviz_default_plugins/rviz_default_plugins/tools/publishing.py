# SPDX-License-Identifier: Apache-2.0
"""The base class of tools that publish messages, and the tool that publishes a clicked point."""

from __future__ import annotations

from typing import Any, ClassVar

from geometry_msgs.msg import PointStamped
from rviz_common.properties import Flag, qos_of, topic_properties
from rviz_common.tool import Point, Tool

__all__ = ['PublishPoint', 'Publishing']


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
        heard = f'{count} listen' if count else 'but nobody listens'
        logger.info(f'{self.NAME}: published to {self._publisher.topic_name}, {heard}.')


class PublishPoint(Publishing):
    """Tool that publishes the clicked point on the ground."""

    CLASS = 'rviz_default_plugins/PublishPoint'
    NAME = 'Publish Point'
    HINT = 'Click on the ground.'
    MESSAGE = PointStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PointStamped', 'clicked_point'),
        Flag('Single click', True, 'Whether the tool is laid down after one click.'),
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
