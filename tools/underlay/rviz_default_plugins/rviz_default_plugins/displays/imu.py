# SPDX-License-Identifier: Apache-2.0
"""The display of the orientation and linear acceleration of an IMU."""

from __future__ import annotations

from typing import Any

import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.properties import ColorOf, Flag, Number, topic_properties
from rviz_common.status import Level
from rviz_common.topic_display import MessageDisplay
from rviz_default_plugins.bodies import add_arrow_to, opacity_of
from rviz_default_plugins.decoding.geometry import position, Quaternion, rotated, rotation
from sensor_msgs.msg import Imu as ImuMessage

__all__ = ['Imu']

BOX, AXES, ARROW = 'Box properties', 'Axes properties', 'Acceleration properties'


class Imu(MessageDisplay):
    """Box and axes with the orientation of an IMU, and an arrow for the acceleration."""

    CLASS = 'rviz_imu_plugin/Imu'
    MESSAGE = ImuMessage
    PROPERTIES = (
        *topic_properties('sensor_msgs/msg/Imu', '/imu'),
        Flag(
            'fixed_frame_orientation',
            True,
            'Whether the orientation is relative to the fixed frame instead of its own.',
        ),
        Flag(f'{BOX}/Enable box', False, 'Whether a box shows the orientation.'),
        Number(f'{BOX}/x_scale', 1.0, 'Length of the box, in metres.', 0.001),
        Number(f'{BOX}/y_scale', 1.0, 'Width of the box, in metres.', 0.001),
        Number(f'{BOX}/z_scale', 1.0, 'Height of the box, in metres.', 0.001),
        ColorOf(f'{BOX}/Box color', (255, 0, 0), 'Colour of the box.'),
        Number(f'{BOX}/Box alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        Flag(f'{AXES}/Enable axes', True, 'Whether axes show the orientation.'),
        Number(f'{AXES}/Axes scale', 1.0, 'Length of the axes, in metres.', 0.001),
        Flag(f'{ARROW}/Enable acceleration', False, 'Whether an arrow shows the acceleration.'),
        Flag(
            f'{ARROW}/Derotate acceleration',
            True,
            'Whether the acceleration is rotated by the orientation.',
        ),
        Number(f'{ARROW}/Acc. vector scale', 1.0, 'Length of the arrow in metres per m/s².', 0.0),
        ColorOf(f'{ARROW}/Acc. vector color', (255, 0, 0), 'Colour of the arrow.'),
        Number(f'{ARROW}/Acc. vector alpha', 1.0, '0 is transparent.', 0.0, 1.0),
    )

    def start(self) -> None:
        """Subscribe to the topic."""
        self._canvas = Canvas(self.context.scene, self.root)
        super().start()

    def show(self, message: Any) -> None:
        """
        Draw what is enabled: the box, the axes and the arrow of the acceleration.

        Parameters
        ----------
        message
            As for `MessageDisplay.show`.

        """
        if message.orientation_covariance[0] == -1.0:
            turn: Quaternion = (1.0, 0.0, 0.0, 0.0)
            self.status.say('Orientation', Level.WARN, 'The IMU does not measure its orientation.')
        else:
            turn = rotation(message.orientation)
            self.status.forget('Orientation')
        with self._canvas.anew():
            if self.values[f'{BOX}/Enable box']:
                self._add_box(turn)
            if self.values[f'{AXES}/Enable axes']:
                self._add_axes(turn)
            if self.values[f'{ARROW}/Enable acceleration']:
                self._add_arrow(message, turn)

    def placed(self, pose: Pose) -> Pose:
        """
        Drop the rotation of the IMU's frame if the orientation is relative to the fixed frame.

        Parameters
        ----------
        pose
            As for `MessageDisplay.placed`.

        """
        return Pose(pose.position) if self.values['fixed_frame_orientation'] else pose

    def _add_box(self, turn: Quaternion) -> None:
        x, y, z = (self.values[f'{BOX}/{axis}_scale'] for axis in 'xyz')
        self._canvas.put(
            'box',
            'box',
            color=self.values[f'{BOX}/Box color'],
            dimensions=(x, y, z),
            opacity=opacity_of(self.values[f'{BOX}/Box alpha']),
            wxyz=turn,
        )

    def _add_axes(self, turn: Quaternion) -> None:
        length = self.values[f'{AXES}/Axes scale']
        self._canvas.put(
            'frame',
            'axes',
            axes_length=length,
            axes_radius=0.05 * length,
            origin_radius=0.05 * length,
            wxyz=turn,
        )

    def _add_arrow(self, message: Any, turn: Quaternion) -> None:
        vector = position(message.linear_acceleration, 'linear acceleration')
        if self.values[f'{ARROW}/Derotate acceleration']:
            vector = tuple(rotated(np.array([vector]), turn)[0])
        scale = self.values[f'{ARROW}/Acc. vector scale']
        x, y, z = (float(part) * scale for part in vector)
        paint = (
            self.values[f'{ARROW}/Acc. vector color'],
            self.values[f'{ARROW}/Acc. vector alpha'],
        )
        add_arrow_to(self._canvas, 'acceleration', (x, y, z), 0.05, paint, (0.0, 0.0, 0.0))
