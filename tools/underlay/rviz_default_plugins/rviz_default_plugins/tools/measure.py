# SPDX-License-Identifier: Apache-2.0
"""The tool that measures distances."""

from __future__ import annotations

from collections.abc import Mapping
import math
from typing import Any

from rviz_common.context import Context
from rviz_common.properties import ColorOf
from rviz_common.tool import Point, Tool

__all__ = ['Measure']

ABOVE_M = 0.02
"""The height of the line in m: slightly above the ground, to be visible."""


class Measure(Tool):
    """
    Tool that measures the distance between two points on the ground.

    Parameters
    ----------
    context, root, given
        As for `Tool`.

    """

    CLASS = 'rviz_default_plugins/Measure'
    NAME = 'Measure'
    HINT = 'Click on two points of the ground, or drag from one to the other.'
    PROPERTIES = (ColorOf('Line color', (128, 128, 0), 'The color of the line.'),)

    def __init__(
        self, context: Context, root: str, given: Mapping[str, Any] | None = None
    ) -> None:
        super().__init__(context, root, given)
        self._first: Point | None = None
        self._drawn: list[Any] = []

    def lay_down(self) -> None:
        """Deactivate the tool."""
        self._first = None
        self._clear()

    def click(self, point: Point) -> bool:
        """
        Handle the click on the first or the second point.

        Parameters
        ----------
        point
            As for `Tool.click`.

        """
        if self._first is None:
            self._first = point
            self._clear()
        else:
            self._show(self._first, point)
            self._first = None
        return False

    def drag(self, start: Point, end: Point, is_over: bool) -> bool:
        """
        Show the distance while the line is drawn.

        Parameters
        ----------
        start, end, is_over
            As for `Tool.drag`.

        """
        self._first = None
        self._show(start, end)
        return False

    def _show(self, start: Point, end: Point) -> None:
        import numpy as np

        self._clear()
        ends = [(*point[:2], point[2] + ABOVE_M) for point in (start, end)]
        middle = tuple((a + b) / 2.0 for a, b in zip(*ends))
        scene = self.context.scene
        self._drawn = [
            scene.add_line_segments(
                f'{self.root}/line',
                np.array([ends], np.float32),
                self.values['Line color'],
                thickness=3.0,
                thickness_units='screen',
            ),
            scene.add_label(
                f'{self.root}/text', f'{math.dist(start, end):.3f} m', position=middle
            ),
        ]

    def _clear(self) -> None:
        for handle in self._drawn:
            handle.remove()
        self._drawn = []
