# SPDX-License-Identifier: Apache-2.0
"""What a robot knows to be where."""

from __future__ import annotations

from importlib import import_module
import math
from typing import Any, TYPE_CHECKING

from robot_console.live import LivePanel, Viewer
from robot_console.namespaces import NAMESPACE
from robot_console.robot_link import LATCHED
from rviz_common.properties import Topic
from rviz_default_plugins.displays.detections import MISSING

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['Objects']

TYPE = 'vision_msgs/msg/Detection3DArray'
TOPIC = 'objects'
MOST_ROWS = 500


class Objects(LivePanel):
    """
    A list of the objects of a latched `vision_msgs/Detection3DArray`.

    An object's name is its longest class (`red mug` beside `mug`); its identity is its `id`. The
    panel appears by itself when somebody publishes `objects`.

    """

    CLASS = 'robot_console/Objects'
    PAGE = 'objects'
    PROPERTIES = (NAMESPACE, Topic('Topic', TOPIC, 'Where objects are published.', TYPE))

    @classmethod
    def is_wanted(cls, node: Node) -> bool:
        """
        Return whether there are remembered objects.

        Parameters
        ----------
        node
            The page's node; the topic is relative to its namespace.

        """
        name = node.resolve_topic_name(TOPIC)
        if not node.count_publishers(name):
            return False
        return any(each.topic_type == TYPE for each in node.get_publishers_info_by_topic(name))

    def settings(self) -> dict[str, Any]:
        """Return what the page is to know from the beginning."""
        return {'topic': self._topic(), 'missing': '' if _message_type() else MISSING}

    def begin(self) -> None:
        """Listen; the topic is latched and seldom changes."""
        self._state: dict[str, Any] = {'objects': [], 'frame': '', 'heard': False, 'left_out': 0}
        kind = _message_type()
        self._subscription = kind and self.context.node.create_subscription(
            kind, self._topic(), self._take, LATCHED
        )

    def greet(self, viewer: Viewer) -> None:
        """
        Tell somebody who comes what is known.

        Parameters
        ----------
        viewer
            Who has opened the panel.

        """
        viewer.tell(**self._state)

    def end(self) -> None:
        """Listen no longer."""
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
    """Return the class of the messages; None if its package is not built."""
    try:
        return import_module('vision_msgs.msg').Detection3DArray
    except (ImportError, AttributeError):
        return None


def _row(detection: Any) -> dict[str, Any]:
    """Return what the page shows of an object: lengths in m, numbers that are none as null."""
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
