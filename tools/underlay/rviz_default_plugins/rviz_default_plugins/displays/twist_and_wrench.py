# SPDX-License-Identifier: Apache-2.0
"""The displays of a linear and an angular vector as arrows: velocity, and force and torque."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import TwistStamped as TwistStampedMessage
from geometry_msgs.msg import WrenchStamped
import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.history_display import HistoryDisplay
from rviz_common.properties import ColorOf, Flag, Number, topic_properties, Whole
from rviz_default_plugins.bodies import add_arrow_to, add_lines, Paint
from rviz_default_plugins.decoding.geometry import along_x, position, Triple

__all__ = ['TwistStamped', 'Wrench']

ORIGIN = (0.0, 0.0, 0.0)


class VectorsDisplay(HistoryDisplay):
    """The last pairs of a straight vector, as arrow, and a turning one, as arrow and circle."""

    def keep(self) -> int:
        """Return the number of pairs shown at once."""
        return int(self.values['History Length'])

    def draw_pair(
        self, canvas: Canvas, straight: Any, turning: Any, names: tuple[str, str]
    ) -> None:
        """
        Draw a linear vector as an arrow, and an angular one as an arrow with a circle around it.

        Parameters
        ----------
        canvas
            Where to draw.
        straight, turning
            The vectors, of the type `geometry_msgs/msg/Vector3`, such as force and torque.
        names
            The names of both in the properties, such as `Force` in `Force Color`.

        Raises
        ------
        ValueError
            A vector is not finite, or too long.

        """
        for name, vector, is_turning in ((names[0], straight, False), (names[1], turning, True)):
            scale = self.values[f'{name} Arrow Scale']
            x, y, z = position(vector, f'{name.lower()} vector')
            scaled = (x * scale, y * scale, z * scale)
            if math.hypot(x, y, z) <= self.smallest():
                continue
            paint = self.values[f'{name} Color'], self.values['Alpha']
            self._add_arrow(canvas, name.lower(), scaled, paint)
            if is_turning:
                self._add_circle(canvas, scaled, paint)

    def smallest(self) -> float:
        """Return the length up to which vectors are not drawn."""
        return 0.0

    def _add_arrow(self, canvas: Canvas, name: str, vector: Triple, paint: Paint) -> None:
        width = 0.1 * self.values['Arrow Width']
        add_arrow_to(canvas, name, vector, width, paint, ORIGIN)

    def _add_circle(self, canvas: Canvas, vector: Triple, paint: Paint) -> None:
        """Draw most of a circle around the vector, with a hook at the end of the rotation."""
        length = math.hypot(*vector)
        if length < 1e-9:
            return
        turns = np.linspace(0.0, 1.75 * math.pi, 33)
        middle, radius = np.full(33, length / 2.0), length / 4.0
        around = np.stack([middle, radius * np.cos(turns), radius * np.sin(turns)], axis=1)
        hook = around[-4] * (1.0, 0.7, 0.7)
        points = np.concatenate([around, [hook]]).astype(np.float32)
        segments = np.stack([points[:-1], points[1:]], axis=1)
        add_lines(canvas, 'circle', segments, paint[0], wxyz=along_x(vector))


class TwistStamped(VectorsDisplay):
    """The last velocities of a topic."""

    CLASS = 'rviz_default_plugins/TwistStamped'
    MESSAGE = TwistStampedMessage
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/TwistStamped', '/twist'),
        ColorOf('Linear Color', (204, 51, 51), 'Colour of the linear velocity.'),
        ColorOf('Angular Color', (204, 204, 51), 'Colour of the angular velocity.'),
        Number('Alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        Number('Linear Arrow Scale', 1.0, 'Length of the arrow in metres per m/s.', 0.0),
        Number('Angular Arrow Scale', 1.0, 'Length of the arrow in metres per rad/s.', 0.0),
        Number('Arrow Width', 0.5, 'Width of the arrows, in decimetres.', 0.0),
        Flag('Hide Small Values', True, 'Whether vectors shorter than 0.00001 are hidden.'),
        Whole('History Length', 1, 'Number shown at once.', 1, 1000),
    )

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw the arrows of the linear and the angular velocity.

        Parameters
        ----------
        canvas, message, pose
            As for `HistoryDisplay.draw`.

        """
        self.draw_pair(canvas, message.twist.linear, message.twist.angular, ('Linear', 'Angular'))

    def smallest(self) -> float:
        """Return the length up to which vectors are not drawn."""
        return 1e-5 if self.values['Hide Small Values'] else 0.0


class Wrench(VectorsDisplay):
    """The last forces and torques of a topic."""

    CLASS = 'rviz_default_plugins/Wrench'
    MESSAGE = WrenchStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/WrenchStamped', '/wrench'),
        ColorOf('Force Color', (204, 51, 51), 'Colour of the force.'),
        ColorOf('Torque Color', (204, 204, 51), 'Colour of the torque.'),
        Number('Alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        Number('Force Arrow Scale', 2.0, 'Length of the arrow in metres per N.', 0.0),
        Number('Torque Arrow Scale', 2.0, 'Length of the arrow in metres per N m.', 0.0),
        Number('Arrow Width', 0.5, 'Width of the arrows, in decimetres.', 0.0),
        Whole('History Length', 1, 'Number shown at once.', 1, 1000),
    )
    UNUSED = ('Accept NaN Values',)

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw the arrows of the force and the torque.

        Parameters
        ----------
        canvas, message, pose
            As for `HistoryDisplay.draw`.

        """
        wrench = message.wrench
        self.draw_pair(canvas, wrench.force, wrench.torque, ('Force', 'Torque'))
