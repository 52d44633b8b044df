# SPDX-License-Identifier: Apache-2.0
"""The tool that publishes a clicked point."""

from __future__ import annotations

from geometry_msgs.msg import PointStamped
from rviz_common.properties import Flag, topic_properties
from rviz_common.tool import Point
from rviz_default_plugins.tools.publishing import Publishing

__all__ = ['PublishPoint']


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
