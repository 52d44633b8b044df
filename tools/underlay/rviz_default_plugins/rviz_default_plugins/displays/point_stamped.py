# SPDX-License-Identifier: Apache-2.0
"""The display of points as spheres."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PointStamped as PointStampedMessage
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.history_display import HistoryDisplay
from rviz_common.properties import ColorOf, Number, topic_properties, Whole
from rviz_default_plugins.bodies import opacity_of
from rviz_default_plugins.decoding.geometry import position

__all__ = ['PointStamped']


class PointStamped(HistoryDisplay):
    """The last points of a topic."""

    CLASS = 'rviz_default_plugins/PointStamped'
    MESSAGE = PointStampedMessage
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PointStamped', '/clicked_point'),
        ColorOf('Color', (204, 41, 204), 'Colour of the spheres.'),
        Number('Alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        Number('Radius', 0.2, 'Radius of the spheres, in metres.', 0.001),
        Whole('History Length', 1, 'Number of points shown at once.', 1, 1000),
    )

    def keep(self) -> int:
        """Return the number of points shown at once."""
        return int(self.values['History Length'])

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw the sphere.

        Parameters
        ----------
        canvas, message, pose
            As for `HistoryDisplay.draw`.

        """
        canvas.put(
            'icosphere',
            'point',
            radius=self.values['Radius'],
            color=self.values['Color'],
            opacity=opacity_of(self.values['Alpha']),
            position=position(message.point, 'point'),
        )
