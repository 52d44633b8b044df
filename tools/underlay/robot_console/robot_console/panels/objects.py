# SPDX-License-Identifier: Apache-2.0
"""Panel with the objects that a robot has detected."""

from __future__ import annotations

from importlib import import_module
import math
from typing import Any, TYPE_CHECKING

from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from robot_console.robot_link import LATCHED
from rviz_common.properties import Topic
from rviz_default_plugins.displays.detections import MISSING

if TYPE_CHECKING:
    from rclpy.node import Node
from rviz_common.page.channel import Viewer

__all__ = ['Objects']

TYPE = 'vision_msgs/msg/Detection3DArray'
TOPIC = 'objects'
MOST_ROWS = 500


class Objects(LivePanel):
    """
    A list of the objects of a latched `vision_msgs/Detection3DArray`.

    The name of an object is its longest class (`red mug` beside `mug`); its identity is its `id`.
    The panel is added automatically when a node publishes `objects`.

    """

    CLASS = 'robot_console/Objects'
    PAGE = 'objects'
    PROPERTIES = (NAMESPACE, Topic('Topic', TOPIC, 'The topic of the objects.', TYPE))

    @classmethod
    def is_wanted(cls, node: Node) -> bool:
        """
        Check whether a node publishes detected objects.

        Parameters
        ----------
        node
            The node of the page; the topic is relative to its namespace.

        """
        name = node.resolve_topic_name(TOPIC)
        if not node.count_publishers(name):
            return False
        return any(each.topic_type == TYPE for each in node.get_publishers_info_by_topic(name))

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {'topic': self._topic(), 'missing': '' if _message_type() else MISSING}

    def begin(self) -> None:
        """Subscribe to the objects; the topic is latched and rarely changes."""
        self._state: dict[str, Any] = {'objects': [], 'frame': '', 'heard': False, 'left_out': 0}
        kind = _message_type()
        self._subscription = kind and self.context.node.create_subscription(
            kind, self._topic(), self._take, LATCHED
        )

    def greet(self, viewer: Viewer) -> None:
        """
        Send the known objects to a new viewer.

        Parameters
        ----------
        viewer
            The viewer that has opened the panel.

        """
        viewer.tell(**self._state)

    def end(self) -> None:
        """Destroy the subscription."""
        if self._subscription:
            self.context.node.destroy_subscription(self._subscription)

    def _topic(self) -> str:
        return self.full_name(self.values['Topic'])

    def _take(self, message: Any) -> None:
        rows = sorted((_row(each) for each in message.detections), key=lambda row: row['id'])
        self._state = {
            'objects': rows[:MOST_ROWS],
            'frame': message.header.frame_id,
            'heard': True,
            'left_out': max(0, len(rows) - MOST_ROWS),
        }
        self.channel.tell(**self._state)


def _message_type() -> Any:
    """Return the message class; None if its package is not built."""
    try:
        return import_module('vision_msgs.msg').Detection3DArray
    except (ImportError, AttributeError):
        return None


def _row(detection: Any) -> dict[str, Any]:
    """Format an object for the page: lengths in m, non-finite values as null."""
    names = [each.hypothesis.class_id for each in detection.results]
    centre, size = detection.bbox.center.position, detection.bbox.size
    variances = [each.pose.covariance[i] for each in detection.results[:1] for i in (0, 7, 14)]
    spread_m = math.sqrt(max(variances)) if variances and min(variances) > 0.0 else None
    return {
        'id': detection.id,
        'name': max(names, key=len, default=''),
        'score': _number(detection.results[0].hypothesis.score if names else math.nan),
        'position': [_number(each) for each in (centre.x, centre.y, centre.z)],
        'size': [_number(each) for each in (size.x, size.y, size.z)],
        'spread': _number(math.nan if spread_m is None else spread_m),
    }


def _number(value: float) -> float | None:
    return round(value, 3) if math.isfinite(value) else None
