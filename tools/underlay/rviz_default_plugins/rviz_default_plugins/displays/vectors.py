# SPDX-License-Identifier: Apache-2.0
"""The base class of displays of a linear and an angular vector, such as force and torque."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from rviz_common.canvas import Canvas
from rviz_common.history_display import HistoryDisplay
from rviz_default_plugins.decoding.geometry import along_x, position, Triple
from rviz_default_plugins.drawing.bodies import add_arrow_to, add_lines, Paint

__all__ = ['VectorsDisplay']

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
