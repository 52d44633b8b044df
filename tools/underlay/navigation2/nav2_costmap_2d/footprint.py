# SPDX-License-Identifier: Apache-2.0
"""Robot footprint: its definition and padding, and collision checks."""

from __future__ import annotations

import json
import math
from typing import Any, NamedTuple

import cv2
from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_costmap_2d.grid import CellArray, Costmap2D, FloatArray
import numpy as np
import numpy.typing as npt

__all__ = [
    'Footprint',
    'FootprintCollisionChecker',
    'is_collision',
    'make_circle',
    'pad',
    'parse_footprint',
    'radii_of',
    'transformed',
]

_CIRCLE_POINTS = 16


class Footprint(NamedTuple):
    """Footprint of a robot, in its base frame."""

    points: FloatArray
    """(N, 2) padded corners in m; those of an inscribed polygon for a circle."""
    inscribed_radius_m: float
    circumscribed_radius_m: float
    is_circular: bool
    """Whether it was defined by a radius."""

    @classmethod
    def of_points(cls, points: npt.ArrayLike, padding_m: float = 0.0) -> Footprint:
        """
        Make the footprint of a polygon.

        Parameters
        ----------
        points
            Corners (N, 2) in m in the base frame, without padding.
        padding_m
            The distance by which each corner is moved away from the axes, in m.

        """
        padded = pad(np.asarray(points, float), padding_m)
        return cls(padded, *radii_of(padded), is_circular=False)

    @classmethod
    def of_radius(cls, radius_m: float, padding_m: float = 0.0) -> Footprint:
        """
        Make the footprint of a circular robot, as a polygon of 16 corners.

        Parameters
        ----------
        radius_m
            The radius in m, without padding.
        padding_m
            The distance by which each corner is moved away from the axes, in m.

        """
        padded = pad(make_circle(radius_m), padding_m)
        return cls(padded, *radii_of(padded), is_circular=True)


def parse_footprint(text: str) -> FloatArray:
    """
    Parse the corners of a footprint.

    Parameters
    ----------
    text
        Such as `[[0.2, 0.1], [0.2, -0.1], [-0.2, -0.1], [-0.2, 0.1]]`: x and y in m.

    Returns
    -------
    (N, 2) corners; (0, 2) if the text is empty or `[]`.

    Raises
    ------
    ValueError
        It has another format; the text is the end of a sentence about it.

    """
    example = "as in '[[0.2, 0.1], [0.2, -0.1], [-0.2, -0.1], [-0.2, 0.1]]'"
    try:
        points: Any = json.loads(text.strip() or '[]')
    except ValueError:
        raise ValueError(f'must be a list of corners, {example}, but is {text!r}') from None
    if points == []:
        return np.empty((0, 2))
    is_list = isinstance(points, list) and all(
        isinstance(point, list)
        and len(point) == 2
        and all(isinstance(each, (int, float)) and math.isfinite(each) for each in point)
        for point in points
    )
    if not is_list:
        raise ValueError(f'must be a list of corners [x, y], {example}, but is {text!r}')
    if len(points) < 3:
        raise ValueError(f'must have at least three corners, but has {len(points)}')
    return np.array(points, float)


def make_circle(radius_m: float) -> FloatArray:
    """
    Make a polygon that approximates a circle around the origin.

    Parameters
    ----------
    radius_m
        The distance of its corners from the origin, in m.

    Returns
    -------
    numpy.ndarray
        Corners (16, 2) in m, counter-clockwise.

    """
    angles = np.arange(_CIRCLE_POINTS) * (2.0 * math.pi / _CIRCLE_POINTS)
    return radius_m * np.column_stack([np.cos(angles), np.sin(angles)])


def pad(points: FloatArray, padding_m: float) -> FloatArray:
    """
    Move the corners of a footprint away from both axes of the base frame.

    Parameters
    ----------
    points
        Corners (N, 2) in m.
    padding_m
        The distance along each axis, in m; coordinates of 0 are unchanged.

    Returns
    -------
    numpy.ndarray
        New corners (N, 2) in m.

    """
    return points + padding_m * np.sign(np.where(np.abs(points) < 1e-9, 0.0, points))


def radii_of(points: FloatArray) -> tuple[float, float]:
    """
    Compute the inscribed and the circumscribed radius of a footprint.

    The inscribed one is the distance from the base frame's origin to the nearest side: the robot
    hits obstacles within it whatever its heading.

    Parameters
    ----------
    points
        Corners (N, 2) in m in the base frame.

    Returns
    -------
    tuple of float
        Both radii in m; 0 if there are fewer than three corners.

    """
    if len(points) < 3:
        return 0.0, 0.0
    starts, sides = points, np.roll(points, -1, axis=0) - points
    lengths = np.maximum((sides**2).sum(axis=1), 1e-12)
    along = np.clip(-(starts * sides).sum(axis=1) / lengths, 0.0, 1.0)
    nearest = starts + along[:, None] * sides
    return float(np.hypot(*nearest.T).min()), float(np.hypot(*points.T).max())


def transformed(points: FloatArray, x: float, y: float, yaw: float) -> FloatArray:
    """
    Transform points from the base frame to the frame of its pose.

    Parameters
    ----------
    points
        Points (..., 2) in m in the base frame.
    x, y, yaw
        The pose of the base frame, in m and rad.

    Returns
    -------
    numpy.ndarray
        New points (..., 2) in m.

    """
    cos, sin = math.cos(yaw), math.sin(yaw)
    moved: FloatArray = points @ np.array([[cos, sin], [-sin, cos]]) + (x, y)
    return moved


def fill_polygon(grid: Costmap2D, points: FloatArray) -> npt.NDArray[np.bool_]:
    """
    Rasterize a polygon: find the cells inside and under its outline.

    Parameters
    ----------
    grid
        The grid, for its size and origin.
    points
        Corners (N, 2) in m in the frame of the grid.

    Returns
    -------
    numpy.ndarray
        Mask of the covered cells (rows, columns).

    """
    mask = np.zeros(grid.cells.shape, np.uint8)
    corners = np.clip(grid.world_to_map_array(points), -(1 << 14), 1 << 14)
    cv2.fillPoly(mask, [corners.astype(np.int32)], 1)
    return mask.view(np.bool_)


def is_collision(cost: int, *, is_circular: bool, allow_unknown: bool = True) -> bool:
    """
    Whether a footprint cost means a collision.

    Parameters
    ----------
    cost
        The cost from `FootprintCollisionChecker`.
    is_circular
        Whether it is the cost at the robot's centre, not one on its outline.
    allow_unknown
        Whether unknown space is allowed.

    """
    if cost == NO_INFORMATION:
        return not allow_unknown
    return cost >= (INSCRIBED_INFLATED_OBSTACLE if is_circular else LETHAL_OBSTACLE)


class FootprintCollisionChecker:
    """
    Collision checker that finds the maximum cost on the outline of a robot.

    Parameters
    ----------
    costmap
        The grid; poses are in its frame.

    """

    def __init__(self, costmap: Costmap2D) -> None:
        self.costmap = costmap
        self._outline: FloatArray = np.empty((0, 2))
        self._outlined: FloatArray | None = None

    def footprint_cost(
        self, pose: tuple[float, float, float], footprint: FloatArray | None
    ) -> int:
        """
        Compute the maximum cost on the outline at a pose.

        Parameters
        ----------
        pose
            x and y in m, yaw in rad: a Pose2D.
        footprint
            (N, 2) corners in m in the base frame; None for a circular robot, of which the cost at
            the centre is returned.

        Returns
        -------
        The cost: LETHAL_OBSTACLE outside of the costmap; NO_INFORMATION only if no obstacle is on
        the outline.

        """
        return int(self.footprint_costs(np.asarray([tuple(pose)], float), footprint)[0])

    def footprint_costs(self, poses: npt.ArrayLike, footprint: FloatArray | None) -> CellArray:
        """
        Compute the maximum costs on the outlines at many poses, as `footprint_cost` for one.

        Parameters
        ----------
        poses
            (M, 3) array of x and y in m, yaw in rad.
        footprint
            (N, 2) corners in m in the base frame, or None for a circular robot.

        Returns
        -------
        (M,) costs.

        """
        poses = np.asarray(poses, float)
        if footprint is None or not len(footprint):
            return self.costmap.costs_at(poses[:, :2])
        outline = self._points_on(footprint)
        cos, sin = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
        x, y = outline.T
        points = np.empty((len(poses), len(outline), 2))
        points[..., 0] = poses[:, :1] + cos * x - sin * y
        points[..., 1] = poses[:, 1:2] + sin * x + cos * y
        costs = self.costmap.costs_at(points)
        highest: CellArray = costs.max(axis=1)
        unknown = highest == NO_INFORMATION
        if unknown.any():
            hits = (costs[unknown] == LETHAL_OBSTACLE).any(axis=1)
            highest[unknown] = np.where(hits, LETHAL_OBSTACLE, NO_INFORMATION)
        return highest

    def _points_on(self, footprint: FloatArray) -> FloatArray:
        """Sample the outline densely enough to skip no cell."""
        if self._outlined is not footprint:
            ends = np.roll(footprint, -1, axis=0)
            parts = []
            for start, end in zip(footprint, ends):
                length = float(np.hypot(*(end - start)))
                count = max(math.ceil(length / self.costmap.resolution), 1)
                parts.append(start + np.arange(count)[:, None] / count * (end - start))
            self._outline, self._outlined = np.concatenate(parts), footprint
        return self._outline
