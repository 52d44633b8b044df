# SPDX-License-Identifier: Apache-2.0
"""Smooth paths without moving them into obstacles."""

from __future__ import annotations

from collections.abc import Callable

from nav2_costmap_2d.costs import INSCRIBED_INFLATED_OBSTACLE, NO_INFORMATION
from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.path_shape import headings
import numpy as np
import numpy.typing as npt

__all__ = ['keep_off_obstacles', 'savitzky_golay', 'segments', 'smooth_path']

FloatArray = npt.NDArray[np.float64]

_HALVINGS = 4
_REACH = 4
_STILL_M = 1e-6


def smooth_path(
    poses: FloatArray,
    smooth: Callable[[FloatArray], FloatArray],
    costmap: Costmap2D | None,
    *,
    enforce_path_inversion: bool = True,
    shortest: int = 3,
) -> FloatArray:
    """
    Smooth a path between its ends and its cusps.

    Parameters
    ----------
    poses
        (N, 3) x and y in m, yaw in rad.
    smooth
        Function that smooths (M, 2) points.
    costmap
        The costmap in the frame of the path, if available.
    enforce_path_inversion
        Whether to keep cusps, and poses with a rotation in place.
    shortest
        Segments of fewer points are unchanged.

    Returns
    -------
    (N, 3) poses, which face along the path, or against it on segments driven backwards. The last
    one is unchanged.

    """
    result = np.array(poses, float)
    whole = [(0, len(poses))] if len(poses) else []
    for begin, end in segments(poses) if enforce_path_inversion else whole:
        if end - begin < max(shortest, 2):
            continue
        points = poses[begin:end, :2]
        wanted = keep_off_obstacles(points, smooth(points), costmap)
        result[begin:end, :2] = wanted
        yaws = headings(wanted)
        apart = np.diff(points, axis=0)
        last = end - 1
        facing = np.cos(poses[begin:last, 2]) * apart[:, 0]
        facing += np.sin(poses[begin:last, 2]) * apart[:, 1]
        if np.count_nonzero(facing < 0.0) > len(facing) / 2:
            yaws += np.pi
        result[begin:last, 2] = yaws[:-1]
    result[:, 2] = np.arctan2(np.sin(result[:, 2]), np.cos(result[:, 2]))
    return result


def segments(poses: FloatArray) -> list[tuple[int, int]]:
    """
    Divide a path at its cusps.

    Parameters
    ----------
    poses
        (N, 3) x and y in m, yaw in rad.

    Returns
    -------
    The first pose of each segment, and the one after its last. A cusp belongs to both.

    """
    if len(poses) < 3:
        return [(0, len(poses))] if len(poses) else []
    apart = np.diff(poses[:, :2], axis=0)
    lengths = np.hypot(*apart.T)
    back = (apart[1:] * apart[:-1]).sum(axis=1) < 0.0
    turned = np.flatnonzero((lengths < _STILL_M) & (np.abs(np.diff(poses[:, 2])) > 1e-6))
    cusps = np.unique(np.concatenate([np.flatnonzero(back) + 1, turned, turned + 1]))
    borders = [0, *(int(each) for each in cusps if 0 < each < len(poses) - 1), len(poses) - 1]
    return [(begin, end + 1) for begin, end in zip(borders, borders[1:])]


def savitzky_golay(points: FloatArray, window_size: int, poly_order: int) -> FloatArray:
    """
    Apply a Savitzky-Golay filter to points; the ends are fixed.

    Parameters
    ----------
    points
        (N, 2) points.
    window_size
        The number of points to fit, odd.
    poly_order
        The order of the polynomial, less than the window size.

    Notes
    -----
    Savitzky and Golay, "Smoothing and differentiation of data by simplified least squares
    procedures", 1964.

    """
    half = window_size // 2
    if len(points) < 3 or half < 1:
        return np.array(points)
    powers = np.vander(np.arange(-half, half + 1), poly_order + 1, increasing=True)
    kernel = np.linalg.pinv(powers)[0]
    padded = np.pad(points, ((half, half), (0, 0)), mode='edge')
    result = np.column_stack([np.convolve(each, kernel[::-1], 'valid') for each in padded.T])
    result[[0, -1]] = points[[0, -1]]
    return result


def keep_off_obstacles(
    points: FloatArray, wanted: FloatArray, costmap: Costmap2D | None
) -> FloatArray:
    """
    Move points only as far as they do not enter obstacles.

    Parameters
    ----------
    points, wanted
        (N, 2) original and desired x and y in m.
    costmap
        The costmap in the same frame; None if unavailable.

    Returns
    -------
    (N, 2) points between both. Unknown space, space off the grid, and points that were already in
    an obstacle do not block.

    """
    if costmap is None or not costmap.cells.size:
        return wanted
    hopeless = _is_blocked(costmap, points)
    share = np.ones(len(points))
    moved = wanted
    for _ in range(_HALVINGS):
        blocked = _is_blocked(costmap, moved) & ~hopeless
        if not blocked.any():
            return moved
        near = np.convolve(blocked, np.ones(2 * _REACH + 1), 'same')[: len(points)] > 0
        share[near] *= 0.4
        moved = points + share[:, None] * (wanted - points)
    blocked = _is_blocked(costmap, moved) & ~hopeless
    moved[blocked] = points[blocked]
    return moved


def _is_blocked(costmap: Costmap2D, points: FloatArray) -> npt.NDArray[np.bool_]:
    costs = costmap.costs_at(points, outside=0)
    blocked: npt.NDArray[np.bool_] = costs >= INSCRIBED_INFLATED_OBSTACLE
    blocked &= costs != NO_INFORMATION
    return blocked
