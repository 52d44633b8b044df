# SPDX-License-Identifier: Apache-2.0
"""The displays of points and lines: spheres, a path and its poses, the outline of a polygon."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import PointStamped as PointStampedMessage
from geometry_msgs.msg import PolygonStamped
from nav_msgs.msg import Path as PathMessage
import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.history_display import HistoryDisplay
from rviz_common.properties import Choice, ColorOf, Number, topic_properties, Vector, Whole
from rviz_common.status import Level
from rviz_common.topic_display import MessageDisplay
from rviz_default_plugins.bodies import add_copies, add_lines, arrow, opacity_of
from rviz_default_plugins.decoding.geometry import (
    finite_points_of,
    Points,
    position,
    rotations_of,
)

__all__ = ['Path', 'PointStamped', 'Polygon']

MOST = 20000


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


class Path(HistoryDisplay):
    """The last paths of a topic."""

    CLASS = 'rviz_default_plugins/Path'
    MESSAGE = PathMessage
    PROPERTIES = (
        *topic_properties('nav_msgs/msg/Path', '/plan'),
        Choice('Line Style', 'Lines', 'Billboards have a width.', ('Lines', 'Billboards')),
        Number('Line Width', 0.03, 'Width of billboards, in metres.', 0.001),
        ColorOf('Color', (25, 255, 0), 'Colour of the line.'),
        Number(
            'Alpha', 1.0, '0 hides the line; other values have no effect in a browser.', 0.0, 1.0
        ),
        Whole('Buffer Length', 1, 'Number of paths shown at once.', 1, 100),
        Vector('Offset', (0.0, 0.0, 0.0), 'Offset of the path, in metres.'),
        Choice('Pose Style', 'None', 'How the poses are drawn.', ('None', 'Axes', 'Arrows')),
        Number('Length', 0.3, 'Length of the axes, in metres.', 0.0),
        Number('Radius', 0.03, 'Radius of the axes, in metres.', 0.0),
        ColorOf('Pose Color', (255, 85, 255), 'Colour of the arrows.'),
        Number('Shaft Length', 0.1, 'Length of the shafts, in metres.', 0.0),
        Number('Shaft Diameter', 0.1, 'Diameter of the shafts, in metres.', 0.0),
        Number('Head Length', 0.2, 'Length of the heads, in metres.', 0.0),
        Number('Head Diameter', 0.3, 'Diameter of the heads, in metres.', 0.0),
    )

    def keep(self) -> int:
        """Return the number of paths shown at once."""
        return int(self.values['Buffer Length'])

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw the line and the poses.

        Parameters
        ----------
        canvas, message, pose
            As for `HistoryDisplay.draw`.

        """
        step = max(1, -(-len(message.poses) // MOST))
        poses = [each.pose for each in message.poses[::step]]
        points = finite_points_of(each.position for each in poses)
        points = points + np.array(self.values['Offset'], dtype=np.float32)
        if len(points) > 1 and self.values['Alpha']:
            self._add_line(canvas, points)
        if len(points) and self.values['Pose Style'] != 'None':
            self._add_poses(canvas, points, poses)
        if step > 1:
            sentence = f'{len(points)} of the {len(message.poses)} poses of the path are shown.'
            self.status.say('Path', Level.WARN, sentence)
        else:
            self.status.forget('Path')

    def _add_line(self, canvas: Canvas, points: Points) -> None:
        segments = np.stack([points[:-1], points[1:]], axis=1)
        is_wide = self.values['Line Style'] == 'Billboards'
        width = self.values['Line Width'] if is_wide else None
        add_lines(canvas, 'line', segments, self.values['Color'], width)

    def _add_poses(self, canvas: Canvas, points: Points, poses: list[Any]) -> None:
        values = self.values
        wxyzs, valid = rotations_of(each.orientation for each in poses)
        if not valid.all():
            lost = len(valid) - int(valid.sum())
            raise ValueError(f'{lost} of its {len(valid)} poses have quaternions of zeros.')
        if values['Pose Style'] == 'Axes':
            canvas.put(
                'batched_axes',
                'poses',
                batched_wxyzs=wxyzs,
                batched_positions=points,
                axes_length=values['Length'],
                axes_radius=values['Radius'],
            )
            return
        shaft = values['Shaft Length'], values['Shaft Diameter'] / 2.0
        surface = arrow(*shaft, values['Head Length'], values['Head Diameter'] / 2.0)
        paint = values['Pose Color'], values['Alpha']
        add_copies(canvas, 'poses', surface, paint, points, wxyzs)


class Polygon(MessageDisplay):
    """The newest polygon of a topic, such as the footprint of a robot."""

    CLASS = 'rviz_default_plugins/Polygon'
    MESSAGE = PolygonStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/PolygonStamped', '/polygon'),
        ColorOf('Color', (25, 255, 0), 'Colour of the line.'),
        Number(
            'Alpha', 1.0, '0 hides the line; other values have no effect in a browser.', 0.0, 1.0
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
