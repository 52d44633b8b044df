# SPDX-License-Identifier: Apache-2.0
"""The arrow on the ground that a user draws."""

from __future__ import annotations

import math
from typing import Any

from rviz_common.context import Context
from rviz_common.tool import Point

__all__ = ['PoseArrow', 'heading']

GREEN = (40, 220, 40)
LONG_M, SHORT_M = 0.7, 0.05


def heading(start: Point, end: Point) -> float:
    """
    Compute the yaw of the direction from one point to another.

    Parameters
    ----------
    start, end
        The points, in m.

    Returns
    -------
    float
        The angle from the x axis, in rad, from -pi to pi.

    """
    return math.atan2(end[1] - start[1], end[0] - start[0])


class PoseArrow:
    """
    An arrow on the ground, at a point and in a direction.

    Parameters
    ----------
    context
        The context, with the scene.
    root
        The path of the arrow in the scene; no node exists before `show`.

    """

    def __init__(self, context: Context, root: str) -> None:
        self._scene = context.scene
        self._root = root
        self._arrow: Any = None

    def show(self, start: Point, yaw: float) -> None:
        """
        Draw the arrow, replacing the previous one.

        Parameters
        ----------
        start
            The position of its tail, in m in the fixed frame.
        yaw
            Its direction, in rad from the x axis.

        """
        import numpy as np

        tip = (start[0] + LONG_M * math.cos(yaw), start[1] + LONG_M * math.sin(yaw), SHORT_M)
        points = np.array([[(*start[:2], SHORT_M), tip]], np.float32)
        if self._arrow is None:
            self._arrow = self._scene.add_arrows(
                self._root, points, GREEN, shaft_radius=0.04, head_radius=0.1, head_length=0.25
            )
        self._arrow.points = points
        self._arrow.visible = True

    def hide(self) -> None:
        """Hide the arrow."""
        if self._arrow is not None:
            self._arrow.visible = False
