# SPDX-License-Identifier: Apache-2.0
"""Support polygon of the feet on the ground."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.planar import cross, dot, limited, Point
from humanoid_description.geometry import convex_hull
import numpy as np


class SupportPolygon:
    """
    Convex hull of points on the ground.

    Parameters
    ----------
    points
        At least three, not all on a line, in any order and frame (m).

    Raises
    ------
    WalkingError
        The hull has no area.

    """

    def __init__(self, points: Sequence[Point]) -> None:
        hull = convex_hull(np.array([(point.real, point.imag) for point in points]))
        self._corners = [complex(x, y) for x, y in hull]
        if len(self._corners) < 3:
            raise WalkingError(f'{len(points)} points on a line are no area to stand on.')
        self._edges = [
            (start, end - start)
            for start, end in zip(self._corners, self._corners[1:] + self._corners[:1])
        ]

    @property
    def corners(self) -> list[Point]:
        """Return the corners, anticlockwise."""
        return list(self._corners)

    def contains(self, point: Point) -> bool:
        """
        Check whether a point lies inside the polygon or on its edge.

        Parameters
        ----------
        point
            In the frame of the corners (m).

        """
        return all(cross(edge, point - start) >= 0.0 for start, edge in self._edges)

    def clamped(self, point: Point) -> Point:
        """
        Project a point onto the polygon.

        Parameters
        ----------
        point
            In the frame of the corners (m).

        Returns
        -------
        Point
            The closest point of the polygon: the same one if it lies inside.

        """
        if self.contains(point):
            return point
        return min((_on_edge(*edge, point) for edge in self._edges), key=lambda q: abs(q - point))


def _on_edge(start: Point, edge: Point, point: Point) -> Point:
    """Project a point onto an edge."""
    share = dot(point - start, edge) / dot(edge, edge)
    return start + limited(share, 0.0, 1.0) * edge
