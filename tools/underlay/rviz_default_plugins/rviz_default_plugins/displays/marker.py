# SPDX-License-Identifier: Apache-2.0
"""The displays of markers, single or in arrays."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rviz_common.properties import Flags, topic_properties
from rviz_common.status import Level
from rviz_common.topic_display import TopicDisplay
from rviz_default_plugins.markers.marker_scene import MarkerScene
from visualization_msgs.msg import Marker as MarkerMessage
from visualization_msgs.msg import MarkerArray as MarkerArrayMessage

__all__ = ['NAMESPACES', 'Marker', 'MarkerArray', 'Markers']

NAMESPACES = Flags('Namespaces', {}, 'Which markers are shown, by their namespace.')


class Markers(TopicDisplay):
    """A display that draws the messages of a topic as markers."""

    def start(self) -> None:
        """Subscribe to the topic."""
        context = self.context
        self._markers = MarkerScene(context.scene, context.frames, self.root, self.status)
        super().start()

    def update(self) -> None:
        """Draw the queued markers."""
        super().update()
        enabled = self.values['Namespaces']
        self._markers.update(self._now_ns(), lambda namespace: enabled.get(namespace, True))
        new = self._markers.namespaces() - set(enabled)
        if new:
            self.values['Namespaces'] = {**enabled, **dict.fromkeys(sorted(new), True)}
        if self.received:
            sentence = f'{self.received} messages received on {self.values["Topic/Value"]}.'
            self.status.say('Topic', Level.OK, sentence)

    def take(self, message: Any) -> None:
        """
        Queue the markers of a message for the next frames.

        Parameters
        ----------
        message
            As for `TopicDisplay.take`.

        """
        self._markers.put(self.markers_of(message), self._now_ns())

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Convert a message to markers.

        Parameters
        ----------
        message
            A message of the topic.

        Returns
        -------
        Iterable[Any]
            Messages of the type `visualization_msgs/msg/Marker`.

        """
        raise NotImplementedError

    def redraw(self) -> None:
        """Do nothing: the next frame shows and hides namespaces."""

    def _now_ns(self) -> int:
        return int(self.context.node.get_clock().now().nanoseconds)


class Marker(Markers):
    """The markers of a topic."""

    CLASS = 'rviz_default_plugins/Marker'
    MESSAGE = MarkerMessage
    PROPERTIES = (
        *topic_properties('visualization_msgs/msg/Marker', '/visualization_marker', depth=10),
        NAMESPACES,
    )

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Wrap the marker, as the only one of its message.

        Parameters
        ----------
        message
            As for `Markers.markers_of`.

        """
        return (message,)


class MarkerArray(Markers):
    """The markers of a topic that has arrays of them."""

    CLASS = 'rviz_default_plugins/MarkerArray'
    MESSAGE = MarkerArrayMessage
    PROPERTIES = (
        *topic_properties('visualization_msgs/msg/MarkerArray', '/visualization_marker_array'),
        NAMESPACES,
    )

    def markers_of(self, message: Any) -> Iterable[Any]:
        """
        Select the markers of an array.

        Parameters
        ----------
        message
            As for `Markers.markers_of`.

        """
        markers: Iterable[Any] = message.markers
        return markers
