# SPDX-License-Identifier: Apache-2.0
"""The outline of a polygon."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PolygonStamped
import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.properties import ColorOf, Number, topic_properties
from rviz_common.topic_display import MessageDisplay
from rviz_default_plugins.bodies import add_lines
from rviz_default_plugins.decoding.geometry import finite_points_of

__all__ = ['Polygon']


class Polygon(MessageDisplay):
    """The newest polygon of a topic, such as the footprint of a robot."""

    CLASS = 'rviz_default_plugins/Polygon'
    MESSAGE = PolygonStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PolygonStamped', '/polygon'),
        ColorOf('Color', (25, 255, 0), 'Colour of the line.'),
        Number(
            'Alpha', 1.0, '0 hides the line; between, a browser makes no difference.', 0.0, 1.0
        ),
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._canvas = Canvas(self.context.scene, self.root)
        super().start()

    def show(self, message: Any) -> None:
        """
        Draw the closed outline.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
        points = finite_points_of(message.polygon.points)
        with self._canvas.anew():
            if len(points) and self.values['Alpha']:
                segments = np.stack([points, np.roll(points, -1, axis=0)], axis=1)
                add_lines(self._canvas, 'line', segments, self.values['Color'])
