# SPDX-License-Identifier: Apache-2.0
"""Cones in front of range sensors."""

from __future__ import annotations

import math
from typing import Any

from rviz_common.canvas import Canvas
from rviz_common.frames import Pose
from rviz_common.history_display import HistoryDisplay
from rviz_common.properties import ColorOf, Number, topic_properties, Whole
from rviz_default_plugins.bodies import add_surface, cone
from rviz_default_plugins.decoding.geometry import FARTHEST
from sensor_msgs.msg import Range as RangeMessage

__all__ = ['Range']


class Range(HistoryDisplay):
    """The last ranges of a topic, as cones that are as long as they are."""

    CLASS = 'rviz_default_plugins/Range'
    MESSAGE = RangeMessage
    PROPERTIES = (
        *topic_properties('sensor_msgs/msg/Range', '/range'),
        ColorOf('Color', (255, 255, 255), 'Colour of the cones.'),
        Number('Alpha', 0.5, '0 is transparent.', 0.0, 1.0),
        Whole('Buffer Length', 1, 'Number of ranges shown at once.', 1, 1000),
    )

    def keep(self) -> int:
        """Return the number of ranges shown at once."""
        return int(self.values['Buffer Length'])

    def draw(self, canvas: Canvas, message: Any, pose: Pose) -> None:
        """
        Draw a cone as long as the range; none if nothing is in range.

        Parameters
        ----------
        canvas, message, pose
            As for `HistoryDisplay.draw`.

        Raises
        ------
        ValueError
            The field of view or the range is invalid, or the cone is too large.

        """
        length = _length(message)
        radius = length * math.tan(message.field_of_view / 2.0)
        if not max(length, radius) <= FARTHEST:
            raise ValueError(f'its cone is {length:g} m long and {radius:g} m wide.')
        if length > 0.0:
            surface = cone(length, radius)
            paint = self.values['Color'], self.values['Alpha']
            add_surface(canvas, 'cone', surface, paint)


def _length(message: Any) -> float:
    """Return the length of the cone, 0 if nothing was hit, or raise ValueError."""
    if not 0.0 <= message.field_of_view < math.pi:
        raise ValueError(
            f'its field of view is {message.field_of_view:g} rad, but must be from 0 to pi.'
        )
    if message.min_range == message.max_range and math.isinf(message.range):
        # A fixed-distance sensor: -inf for a detection, +inf for none.
        return float(message.min_range) if message.range < 0.0 else 0.0
    if math.isnan(message.range):
        raise ValueError('its range is not a number.')
    return float(message.range) if message.min_range <= message.range <= message.max_range else 0.0
