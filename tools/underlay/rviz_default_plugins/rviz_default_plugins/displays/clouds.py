# SPDX-License-Identifier: Apache-2.0
"""The displays of laser scans and point clouds, coloured by their channels."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.history_display import HistoryDisplay
from rviz_common.properties import (
    Choice,
    ColorOf,
    Flag,
    Number,
    Property,
    Text,
    topic_properties,
    Whole,
)
from rviz_common.status import Level
from rviz_default_plugins.decoding.clouds import (
    Cloud,
    colors_rgb8,
    colors_rgbf32,
    decode_cloud,
    decode_scan,
    Scale,
)
from rviz_default_plugins.decoding.geometry import rotated
from sensor_msgs.msg import LaserScan as LaserScanMessage
from sensor_msgs.msg import PointCloud2 as PointCloud2Message

__all__ = ['LaserScan', 'PointCloud2']

STYLES = ('Points', 'Squares', 'Flat Squares', 'Spheres', 'Boxes', 'Tiles')
INTENSITY, AXIS, FLAT, RGB8, RGBF32 = 'Intensity', 'AxisColor', 'FlatColor', 'RGB8', 'RGBF32'
BOUNDS = 'Autocompute Value Bounds'
PIXEL = 0.004
"""The size of a pixel in m, since viser supports point sizes in metres only."""

CLOUD: tuple[Property, ...] = (
    Choice('Style', 'Flat Squares', 'How a point is drawn.', STYLES),
    Whole('Size (Pixels)', 3, 'Size of Points.', 1, 100),
    Number('Size (m)', 0.01, 'Size of all other styles, in metres.', 0.0001),
    Number(
        'Alpha', 1.0, '0 hides the points; other values have no effect in a browser.', 0.0, 1.0
    ),
    Number('Decay Time', 0.0, 'Seconds for which points stay; 0: until the next message.', 0.0),
    Choice(
        'Color Transformer',
        '',
        'What determines the colours.',
        ('', INTENSITY, AXIS, FLAT, RGB8, RGBF32),
    ),
    ColorOf('Color', (255, 255, 255), 'Colour for FlatColor.'),
    Text('Channel Name', 'intensity', 'Field for Intensity.'),
    Flag('Use rainbow', True, 'Whether Intensity is shown in rainbow colours.'),
    Flag('Invert Rainbow', False, 'Whether the rainbow is inverted.'),
    ColorOf('Min Color', (0, 0, 0), 'Colour of the lowest intensity.'),
    ColorOf('Max Color', (255, 255, 255), 'Colour of the highest intensity.'),
    Flag(
        'Autocompute Intensity Bounds', True, 'Whether the limits are computed from each message.'
    ),
    Number('Min Intensity', 0.0, 'Least intensity.'),
    Number('Max Intensity', 4096.0, 'Greatest intensity.'),
    Choice('Axis', 'Z', 'Axis for AxisColor.', ('X', 'Y', 'Z')),
    Flag('Use Fixed Frame', True, 'Whether the axis is that of the fixed frame.'),
    Flag(f'{BOUNDS}/Value', True, 'Whether the limits are computed from each message.'),
    Number(f'{BOUNDS}/Min Value', -10.0, 'Minimum position on the axis, in metres.'),
    Number(f'{BOUNDS}/Max Value', 10.0, 'Maximum position on the axis, in metres.'),
)


class CloudDisplay(HistoryDisplay):
    """The last points of a topic."""

    UNUSED = ('Position Transformer', 'Selectable')
    MOST_POINTS: ClassVar[int] = 200_000
    MOST_DECAYING: ClassVar[int] = 20_000

    def decode(self, message: Any) -> Cloud:
        """
        Convert a message to points.

        Parameters
        ----------
        message
            A message of the topic.

        Returns
        -------
        Cloud
            The points in the frame of the message, in m.

        Raises
        ------
        ValueError
            The message is invalid; the reason is shown in the status.

        """
        raise NotImplementedError

    def decay_s(self) -> float:
        """Return the decay time of points in seconds."""
        return float(self.values['Decay Time'])

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw the points, downsampled to the number that a browser can show.

        Parameters
        ----------
        canvas, message, pose
            As for `HistoryDisplay.draw`.

        """
        cloud = self.decode(message).finite()
        shown = cloud.thinned(self.MOST_DECAYING if self.decay_s() else self.MOST_POINTS)
        if len(shown) < len(cloud):
            sentence = f'{len(shown)} of {len(cloud)} points are shown.'
            self.status.say('Points', Level.WARN, sentence)
        else:
            self.status.forget('Points')
        if len(shown) and self.values['Alpha']:
            self._add(canvas, shown, self._colors(shown, pose))

    def _add(self, canvas: Canvas, cloud: Cloud, colors: Any) -> None:
        style = self.values['Style']
        is_round = style == 'Spheres'
        pixels = self.values['Size (Pixels)'] * PIXEL
        canvas.put(
            'point_cloud',
            'points',
            points=cloud.points,
            colors=colors,
            precision='float32',
            point_size=pixels if style == 'Points' else self.values['Size (m)'],
            point_shape='circle' if is_round else 'square',
            point_shading='gradient' if is_round else 'flat',
        )

    def _colors(self, cloud: Cloud, pose: Pose) -> Any:
        """Return the selected colours, or the best available ones."""
        asked = self.values['Color Transformer']
        kinds = [asked] if asked else []
        kinds += [kind for kind in (RGB8, RGBF32, INTENSITY, FLAT) if kind != asked]
        for kind in kinds:
            colors = self._transformed(kind, cloud, pose)
            if colors is not None:
                break
        if asked in ('', kind):
            self.status.forget('Color Transformer')
        else:
            has = ', '.join(cloud.channels) or 'none besides x, y and z'
            sentence = f'The points have no fields for {asked}, but {has}; {kind} is used.'
            self.status.say('Color Transformer', Level.WARN, sentence)
        return colors

    def _transformed(self, kind: str, cloud: Cloud, pose: Pose) -> Any:
        """Return the colours of a transformer, or None if the cloud lacks the channels."""
        if kind == RGB8:
            return colors_rgb8(cloud)
        if kind == RGBF32:
            return colors_rgbf32(cloud)
        if kind == FLAT:
            return self.values['Color']
        if kind == AXIS:
            return self._axis_scale().paint(self._heights(cloud, pose))
        values = cloud.channels.get(self.values['Channel Name'])
        return None if values is None else self._intensity_scale().paint(values)

    def _heights(self, cloud: Cloud, pose: Pose) -> NDArray[np.float32]:
        """Return the coordinates of the points along the axis."""
        axis = 'XYZ'.index(self.values['Axis'])
        if not self.values['Use Fixed Frame']:
            return cloud.points[:, axis]
        turned: NDArray[np.float32] = rotated(cloud.points, pose.wxyz)
        heights: NDArray[np.float32] = turned[:, axis] + np.float32(pose.position[axis])
        return heights

    def _axis_scale(self) -> Scale:
        if self.values[f'{BOUNDS}/Value']:
            return Scale()
        return Scale(self.values[f'{BOUNDS}/Min Value'], self.values[f'{BOUNDS}/Max Value'])

    def _intensity_scale(self) -> Scale:
        is_auto = self.values['Autocompute Intensity Bounds']
        return Scale(
            None if is_auto else self.values['Min Intensity'],
            None if is_auto else self.values['Max Intensity'],
            self.values['Use rainbow'],
            self.values['Invert Rainbow'],
            (self.values['Min Color'], self.values['Max Color']),
        )


class LaserScan(CloudDisplay):
    """The last scans of a topic."""

    CLASS = 'rviz_default_plugins/LaserScan'
    MESSAGE = LaserScanMessage
    PROPERTIES = (*topic_properties('sensor_msgs/msg/LaserScan', '/scan'), *CLOUD)

    def decode(self, message: Any) -> Cloud:
        """
        Convert a scan to points.

        Parameters
        ----------
        message
            As for `CloudDisplay.decode`.

        """
        return decode_scan(message)


class PointCloud2(CloudDisplay):
    """The last clouds of a topic."""

    CLASS = 'rviz_default_plugins/PointCloud2'
    MESSAGE = PointCloud2Message
    PROPERTIES = (*topic_properties('sensor_msgs/msg/PointCloud2', '/points'), *CLOUD)

    def decode(self, message: Any) -> Cloud:
        """
        Convert a message to points.

        Parameters
        ----------
        message
            As for `CloudDisplay.decode`.

        """
        return decode_cloud(message)
