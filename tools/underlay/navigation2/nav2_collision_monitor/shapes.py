# SPDX-License-Identifier: Apache-2.0
"""Shapes of the zones around the robot, in the base frame; velocity polygons choose theirs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import json
import math
from typing import Union

from nav2_util.twist import Velocity
import numpy as np
import numpy.typing as npt

__all__ = [
    'Circle',
    'Polygon',
    'Shape',
    'VelocityPolygon',
    'checked_corners',
    'choose_polygon',
    'parse_points',
]

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
_CIRCLE_CORNERS = 32


@dataclass(frozen=True)
class Circle:
    """A circle around the origin of the base frame."""

    radius_m: float

    @property
    def reach_m(self) -> float:
        """Return the maximum distance of the outline from the origin."""
        return self.radius_m

    @property
    def outline(self) -> FloatArray:
        """Return a polygon that approximates the circle: (N, 2) array in m."""
        angles = np.linspace(0.0, 2.0 * math.pi, _CIRCLE_CORNERS, endpoint=False)
        return self.radius_m * np.column_stack([np.cos(angles), np.sin(angles)])

    def contains(self, points: FloatArray) -> BoolArray:
        """
        Find the points inside.

        Parameters
        ----------
        points
            Points (..., 2) in m in the base frame.

        Returns
        -------
        numpy.ndarray
            Mask of the points inside or on the outline (...).

        """
        inside = np.einsum('...i,...i', points, points) <= self.radius_m**2
        return np.asarray(inside, dtype=np.bool_)


@dataclass(frozen=True)
class Polygon:
    """A polygon, convex or not, given by its corners: (N, 2) array in m."""

    corners: FloatArray

    @property
    def reach_m(self) -> float:
        """Return the maximum distance of the outline from the origin."""
        return float(np.hypot(self.corners[:, 0], self.corners[:, 1]).max())

    @property
    def outline(self) -> FloatArray:
        """Return the corners."""
        return self.corners

    def contains(self, points: FloatArray) -> BoolArray:
        """
        Find the points inside.

        A point is inside if a ray from it along x crosses the outline an odd number of times
        (Shimrat, Algorithm 112, 1962); points outside of the bounding box are skipped.

        Parameters
        ----------
        points
            Points (..., 2) in m in the base frame.

        Returns
        -------
        numpy.ndarray
            Mask of the points inside (...).

        """
        flat = points.reshape(-1, 2)
        inside = np.zeros(len(flat), dtype=np.bool_)
        low, high = self.corners.min(axis=0), self.corners.max(axis=0)
        near = np.flatnonzero(np.all((flat >= low) & (flat <= high), axis=1))
        x, y = flat[near, 0], flat[near, 1]
        odd = np.zeros(len(near), dtype=np.bool_)
        for (x1, y1), (x2, y2) in zip(self.corners, np.roll(self.corners, -1, axis=0)):
            if y1 != y2:
                crossing = x1 + (y - y1) * ((x2 - x1) / (y2 - y1))
                odd ^= ((y1 > y) != (y2 > y)) & (x < crossing)
        inside[near] = odd
        return inside.reshape(points.shape[:-1])


Shape = Union[Circle, Polygon]


def parse_points(text: str) -> FloatArray:
    """
    Parse the corners of a polygon from a parameter such as `[[0.3, 0.2], [0.3, -0.2], ...]`.

    Parameters
    ----------
    text
        A list of pairs of x and y in m in the base frame.

    Returns
    -------
    numpy.ndarray
        (N, 2) array, N at least 3.

    Raises
    ------
    ValueError
        It is not such a list; the text continues after 'The points'.

    """
    try:
        values = json.loads(text)
    except ValueError as error:
        raise ValueError(
            f'are not a list of pairs such as "[[0.3, 0.2], ...]": {error}'
        ) from error
    if not isinstance(values, list) or not all(_is_pair(each) for each in values):
        raise ValueError(f'must be a list of pairs such as "[[0.3, 0.2], ...]", but are: {text}')
    return checked_corners(np.asarray(values, dtype=np.float64).reshape(-1, 2))


def checked_corners(corners: FloatArray) -> FloatArray:
    """
    Check that corners form a polygon.

    Parameters
    ----------
    corners
        Corners (N, 2) in m.

    Returns
    -------
    numpy.ndarray
        The same array.

    Raises
    ------
    ValueError
        There are fewer than three, or some are not finite; the text continues after 'The points'.

    """
    if len(corners) < 3:
        raise ValueError(f'must be at least three; there are {len(corners)}')
    if not np.all(np.isfinite(corners)):
        raise ValueError('must be finite numbers')
    return corners


def _is_pair(value: object) -> bool:
    return (
        isinstance(value, list)
        and len(value) == 2
        and all(isinstance(each, (int, float)) and not isinstance(each, bool) for each in value)
    )


@dataclass(frozen=True)
class VelocityPolygon:
    """
    Polygon and its range of velocities: m/s, rad/s, rad; limits are inclusive.

    For robots that move sideways, `linear` is the speed and `direction` its direction in the base
    frame, from the start angle counter-clockwise to the end angle; else `linear` is that along x.
    """

    name: str
    shape: Polygon
    linear_min: float
    linear_max: float
    theta_min: float
    theta_max: float
    direction_start_angle: float = -math.pi
    direction_end_angle: float = math.pi

    def covers(self, velocity: Velocity, is_holonomic: bool) -> bool:
        """
        Whether a velocity is in the range of this polygon.

        Parameters
        ----------
        velocity
            The velocity in the base frame.
        is_holonomic
            Whether the robot moves sideways, so that speed and direction are compared instead of
            x.

        """
        linear = velocity.linear if is_holonomic else velocity.x
        if not self.linear_min <= linear <= self.linear_max:
            return False
        if not self.theta_min <= velocity.yaw <= self.theta_max:
            return False
        return not is_holonomic or self._has_direction(math.atan2(velocity.y, velocity.x))

    def _has_direction(self, angle: float) -> bool:
        start, end = self.direction_start_angle, self.direction_end_angle
        if start <= end:
            return start <= angle <= end
        return angle >= start or angle <= end


def choose_polygon(
    polygons: Sequence[VelocityPolygon], velocity: Velocity, is_holonomic: bool
) -> VelocityPolygon | None:
    """
    Choose the first polygon that covers a velocity.

    Parameters
    ----------
    polygons
        The polygons of a zone, in order.
    velocity, is_holonomic
        As for `VelocityPolygon.covers`.

    Returns
    -------
    VelocityPolygon or None
        None if no polygon covers it.

    """
    return next((each for each in polygons if each.covers(velocity, is_holonomic)), None)
