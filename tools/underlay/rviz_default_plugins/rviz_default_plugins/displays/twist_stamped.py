# SPDX-License-Identifier: Apache-2.0
"""Linear and angular velocity as arrows."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import TwistStamped as TwistStampedMessage
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.properties import ColorOf, Flag, Number, topic_properties, Whole
from rviz_default_plugins.displays.vectors import VectorsDisplay

__all__ = ['TwistStamped']


class TwistStamped(VectorsDisplay):
    """The last velocities of a topic."""

    CLASS = 'rviz_default_plugins/TwistStamped'
    MESSAGE = TwistStampedMessage
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/TwistStamped', '/twist'),
        ColorOf('Linear Color', (204, 51, 51), 'Colour of the linear velocity.'),
        ColorOf('Angular Color', (204, 204, 51), 'Colour of the angular velocity.'),
        Number('Alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        Number('Linear Arrow Scale', 1.0, 'Metres for a metre per second.', 0.0),
        Number('Angular Arrow Scale', 1.0, 'Metres for a radian per second.', 0.0),
        Number('Arrow Width', 0.5, 'Width of the arrows, in decimetres.', 0.0),
        Flag('Hide Small Values', True, 'Whether vectors shorter than 0.00001 are hidden.'),
        Whole('History Length', 1, 'How many are shown at once.', 1, 1000),
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
