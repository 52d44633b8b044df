# SPDX-License-Identifier: Apache-2.0
"""Raytracing of sensor points: cells with points are occupied, those in front of them free."""

from __future__ import annotations

from dataclasses import dataclass
import math

import cv2
from nav2_costmap_2d.costs import FREE_SPACE, LETHAL_OBSTACLE
from nav2_costmap_2d.grid import Costmap2D, FloatArray
import numpy as np
import numpy.typing as npt

__all__ = ['Observation', 'clear_rays', 'mark_points']

_FAR = 1 << 14


@dataclass(frozen=True)
class Observation:
    """Observation of a sensor at one time, in the frame of the costmap."""

    origin: FloatArray
    """(3,) position of the sensor in m."""
    points: FloatArray
    """(N, 3) observed points, in m."""
    is_hit: npt.NDArray[np.bool_] | None = None
    """
    (N,) whether each point is a surface, not the maximum range of the sensor; None if all are.
    """


def clear_rays(
    grid: Costmap2D, observation: Observation, min_range_m: float, max_range_m: float
) -> None:
    """
    Clear the cells between a sensor and its points, in place.

    Parameters
    ----------
    grid
        The cells.
    observation
        The points.
    min_range_m, max_range_m
        The part of each ray to clear, from the sensor.

    """
    if not len(observation.points):
        return
    origin = observation.origin[:2]
    rays = observation.points[:, :2] - origin
    lengths = np.hypot(rays[:, 0], rays[:, 1])
    far = lengths > max_range_m
    if far.any():
        rays = rays * np.where(far, max_range_m / np.maximum(lengths, 1e-9), 1.0)[:, None]
    if min_range_m <= 0.0:
        # One polyline to each point and back takes a third of the time of many lines.
        fan = np.empty((2 * len(rays), 2))
        fan[0::2], fan[1::2] = origin, rays + origin
        cv2.polylines(grid.cells, [_drawable(grid, fan)], False, FREE_SPACE)
        return
    keep = lengths > min_range_m
    directions = rays[keep] / np.minimum(lengths[keep], max_range_m)[:, None]
    ends = np.stack([directions * min_range_m, rays[keep]], axis=1) + origin
    cv2.polylines(grid.cells, list(_drawable(grid, ends)), False, FREE_SPACE)


def _drawable(grid: Costmap2D, points: FloatArray) -> npt.NDArray[np.int32]:
    return np.clip(grid.world_to_map_array(points), -_FAR, _FAR).astype(np.int32)


def mark_points(
    grid: Costmap2D,
    observation: Observation,
    min_range_m: float,
    max_range_m: float,
    heights_m: tuple[float, float] = (-math.inf, math.inf),
    threshold: int = 0,
) -> None:
    """
    Mark the cells with points as occupied, in place.

    Parameters
    ----------
    grid
        The cells.
    observation
        The points.
    min_range_m, max_range_m
        The range limits of points that mark, from the sensor.
    heights_m
        The height limits of points that mark.
    threshold
        The number of points that a cell must exceed.

    """
    away = observation.points - observation.origin
    squares = np.einsum('ij,ij->i', away, away)
    heights = observation.points[:, 2]
    counts = (
        (squares <= max_range_m**2)
        & (squares >= min_range_m**2)
        & (heights >= heights_m[0])
        & (heights <= heights_m[1])
    )
    if observation.is_hit is not None:
        counts &= observation.is_hit
    cells = grid.world_to_map_array(observation.points[counts, :2])
    size = (grid.size_x, grid.size_y)
    cells = cells[((cells >= 0) & (cells < size)).all(axis=1)]
    if threshold > 0:
        cells, numbers = np.unique(cells, axis=0, return_counts=True)
        cells = cells[numbers > threshold]
    grid.cells[cells[:, 1], cells[:, 0]] = LETHAL_OBSTACLE
