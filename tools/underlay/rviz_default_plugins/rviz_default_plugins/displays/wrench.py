# SPDX-License-Identifier: Apache-2.0
"""Force and torque as arrows."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import WrenchStamped
from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.properties import ColorOf, Number, topic_properties, Whole
from rviz_default_plugins.displays.vectors import VectorsDisplay

__all__ = ['Wrench']


class Wrench(VectorsDisplay):
    """The last forces and torques of a topic."""

    CLASS = 'rviz_default_plugins/Wrench'
    MESSAGE = WrenchStamped
    PROPERTIES = (
        *topic_properties('geometry_msgs/msg/WrenchStamped', '/wrench'),
        ColorOf('Force Color', (204, 51, 51), 'Colour of the force.'),
        ColorOf('Torque Color', (204, 204, 51), 'Colour of the torque.'),
        Number('Alpha', 1.0, '0 is transparent.', 0.0, 1.0),
        Number('Force Arrow Scale', 2.0, 'Metres for a newton.', 0.0),
        Number('Torque Arrow Scale', 2.0, 'Metres for a newton metre.', 0.0),
        Number('Arrow Width', 0.5, 'Width of the arrows, in decimetres.', 0.0),
        Whole('History Length', 1, 'How many are shown at once.', 1, 1000),
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
