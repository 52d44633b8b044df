# SPDX-License-Identifier: Apache-2.0
"""Detected objects: the displays of `vision_msgs_rviz_plugins`, drawn as markers are."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib import import_module
from itertools import combinations, product
import math
from typing import Any, ClassVar
import zlib

from geometry_msgs.msg import Point
from rviz_common.properties import Choice, ColorOf, Flag, Number, topic_properties
from rviz_common.status import Level
from rviz_default_plugins.displays.marker import Markers, NAMESPACES
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker as MarkerMessage

__all__ = ['BoundingBox3D', 'BoundingBox3DArray', 'Detection3D', 'Detection3DArray']

MISSING = (
    'The message package vision_msgs is not built. Run `make setup` in the project, source the '
    'workspace again, and restart RViz.'
)
BY_CLASS, FLAT = 'By class', 'Flat'
_PALETTE = (
    (230, 60, 50), (60, 130, 230), (70, 180, 80), (240, 200, 40),
    (240, 140, 30), (160, 80, 200), (240, 130, 170), (60, 190, 190),
)  # fmt: skip
_COLORS = {
    'red': (217, 31, 26), 'blue': (38, 77, 217), 'green': (38, 153, 51), 'yellow': (242, 217, 26),
    'orange': (242, 128, 26), 'purple': (128, 51, 153), 'pink': (242, 128, 166),
    'brown': (115, 71, 38), 'white': (242, 242, 242), 'grey': (128, 128, 128),
    'black': (20, 20, 20),
}  # fmt: skip
_LEAST_M = 0.005
_ABOVE_M = 0.05
_LETTERS_M = 0.08
_CORNERS = tuple(product((-0.5, 0.5), repeat=3))
_EDGES = tuple(
    (a, b) for a, b in combinations(_CORNERS, 2) if sum(x != y for x, y in zip(a, b)) == 1
)
_BOX = (
    Number('Alpha', 0.5, '0 is transparent.', 0.0, 1.0),
    ColorOf('Color', (255, 196, 0), 'Colour of flat boxes, and of boxes without a class.'),
    Flag('Only Edge', False, 'Whether only the edges of boxes are drawn.'),
    Number('Line Width', 0.01, 'Width of edges, in metres.', 0.0),
)
_LABEL = (
    Choice(
        'Color Style',
        BY_CLASS,
        'Boxes have the colour in the name of their class (a red mug), or else one colour for '
        'each class; or all have the same.',
        (BY_CLASS, FLAT),
    ),
    Flag('Show Label', True, 'Whether ids, or else classes, are shown above boxes.'),
    Flag('Show Score', False, 'Whether scores are shown after them.'),
)


class BoundingBox3DArray(Markers):
    """The boxes of a topic."""

    CLASS = 'vision_msgs_rviz_plugins/BoundingBox3DArray'
    NAME: ClassVar[str] = 'BoundingBox3DArray'
    PROPERTIES = (
        *topic_properties('vision_msgs/msg/BoundingBox3DArray', '/boxes'), *_BOX, NAMESPACES,
    )  # fmt: skip

    def start(self) -> None:
        """Subscribe to the topic, if its type is available."""
        self._newest: Any = None
        try:
            super().start()
        except ImportError:
            self.status.say('Topic', Level.ERROR, MISSING)

    def message_type(self, topic: str) -> type:
        """
        Import the class of the messages.

        Parameters
        ----------
        topic
            The topic; the class is the same for all topics.

        Raises
        ------
        ImportError
            The package `vision_msgs` is not built.

        """
        kind: type = getattr(import_module('vision_msgs.msg'), self.NAME)
        return kind

    def take(self, message: Any) -> None:
        """
        Store a message for `redraw`, and queue its markers for the next frames.

        Parameters
        ----------
        message
            As for `Markers.take`.

        """
        self._newest = message
        super().take(message)

    def redraw(self) -> None:
        """Redraw the newest message, with the changed properties."""
        if self._newest is not None:
            super().take(self._newest)

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Make a marker for each box, after one that deletes those of the previous message.

        Parameters
        ----------
        message
            As for `Markers.markers_of`.

        """
        yield MarkerMessage(action=MarkerMessage.DELETEALL)
        for number, box in enumerate(self.boxes_of(message)):
            yield self._box(message.header, number, box, self.values['Color'])

    def boxes_of(self, message: Any) -> Iterable[Any]:
        """
        Select the boxes of a message.

        Parameters
        ----------
        message
            A message of the topic.

        Returns
        -------
        Iterable[Any]
            Messages of the type `vision_msgs/msg/BoundingBox3D`.

        """
        boxes: Iterable[Any] = message.boxes
        return boxes

    def _box(self, header: Header, number: int, box: Any, color: tuple[int, ...]) -> MarkerMessage:
        """Make the marker of a box: solid, or its edges only."""
        marker = MarkerMessage(header=header, ns='boxes', id=number, type=MarkerMessage.CUBE)
        marker.pose = box.center
        red, green, blue = (value / 255.0 for value in color)
        marker.color = ColorRGBA(r=red, g=green, b=blue, a=float(self.values['Alpha']))
        size = [_size(each) for each in (box.size.x, box.size.y, box.size.z)]
        marker.scale.x, marker.scale.y, marker.scale.z = size
        if self.values['Only Edge']:
            marker.type, marker.scale.x = MarkerMessage.LINE_LIST, self.values['Line Width']
            marker.points = [
                Point(x=end[0] * size[0], y=end[1] * size[1], z=end[2] * size[2])
                for edge in _EDGES
                for end in edge
            ]
        return marker


class BoundingBox3D(BoundingBox3DArray):
    """The newest box of a topic; it has no header, so it is in the fixed frame."""

    CLASS = 'vision_msgs_rviz_plugins/BoundingBox3D'
    NAME = 'BoundingBox3D'
    PROPERTIES = (
        *topic_properties('vision_msgs/msg/BoundingBox3D', '/box'), *_BOX, NAMESPACES,
    )  # fmt: skip

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Make the marker of the box, in the fixed frame.

        Parameters
        ----------
        message
            As for `Markers.markers_of`.

        """
        header = Header(frame_id=self.context.frames.fixed_frame)
        yield self._box(header, 0, message, self.values['Color'])


class Detection3DArray(BoundingBox3DArray):
    """Detected objects: boxes with ids, classes and scores."""

    CLASS = 'vision_msgs_rviz_plugins/Detection3DArray'
    NAME = 'Detection3DArray'
    PROPERTIES = (
        *topic_properties('vision_msgs/msg/Detection3DArray', '/detections_3d'),
        *_BOX, *_LABEL, NAMESPACES,
    )  # fmt: skip

    def detections_of(self, message: Any) -> Iterable[Any]:
        """
        Select the detections of a message.

        Parameters
        ----------
        message
            A message of the topic.

        Returns
        -------
        Iterable[Any]
            Messages of the type `vision_msgs/msg/Detection3D`.

        """
        detections: Iterable[Any] = message.detections
        return detections

    def markers_of(self, message: Any) -> Iterator[Any]:
        """
        Make a box and a label for each detection, after a marker that deletes the previous ones.

        Parameters
        ----------
        message
            As for `Markers.markers_of`.

        """
        yield MarkerMessage(action=MarkerMessage.DELETEALL)
        for number, detection in enumerate(self.detections_of(message)):
            header = message.header
            yield self._box(header, number, detection.bbox, self._color(detection))
            if text := self._text(detection):
                yield _label(header, number, detection.bbox, text)

    def _color(self, detection: Any) -> tuple[int, ...]:
        """Return the colour of a detection: its own, if it has one, else that of its class."""
        flat: tuple[int, ...] = self.values['Color']
        if self.values['Color Style'] == FLAT or not detection.results:
            return flat
        for result in detection.results:
            first, _, rest = result.hypothesis.class_id.partition(' ')
            if rest and first in _COLORS:
                return _COLORS[first]
        name = detection.results[0].hypothesis.class_id
        return _PALETTE[zlib.crc32(name.encode()) % len(_PALETTE)] if name else flat

    def _text(self, detection: Any) -> str:
        """Format the label of a detection."""
        words = []
        if self.values['Show Label']:
            names = [result.hypothesis.class_id for result in detection.results]
            words.append(detection.id or max(names, key=len, default=''))
        if self.values['Show Score'] and detection.results:
            words.append(f'{detection.results[0].hypothesis.score:.2f}')
        return ' '.join(filter(None, words))


class Detection3D(Detection3DArray):
    """The newest detected object of a topic."""

    CLASS = 'vision_msgs_rviz_plugins/Detection3D'
    NAME = 'Detection3D'
    PROPERTIES = (
        *topic_properties('vision_msgs/msg/Detection3D', '/detection_3d'),
        *_BOX, *_LABEL, NAMESPACES,
    )  # fmt: skip

    def detections_of(self, message: Any) -> Iterable[Any]:
        """
        Wrap the detection, as the only one of its message.

        Parameters
        ----------
        message
            As for `Detection3DArray.detections_of`.

        """
        return (message,)


def _size(value: float) -> float:
    """Return the edge length, with a visible minimum; non-finite values are kept."""
    return max(value, _LEAST_M) if math.isfinite(value) else value


def _label(header: Header, number: int, box: Any, text: str) -> MarkerMessage:
    """Make the marker of a label above a box."""
    marker = MarkerMessage(header=header, ns='labels', id=number, text=text)
    marker.type = MarkerMessage.TEXT_VIEW_FACING
    at = box.center.position
    marker.pose.position = Point(x=at.x, y=at.y, z=at.z + 0.5 * max(box.size.z, 0.0) + _ABOVE_M)
    marker.pose.orientation.w, marker.scale.z = 1.0, _LETTERS_M
    marker.color = ColorRGBA(r=1.0, g=1.0, b=1.0, a=1.0)
    return marker
