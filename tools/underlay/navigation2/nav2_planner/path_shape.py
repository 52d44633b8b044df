# SPDX-License-Identifier: Apache-2.0
"""The shape of a path: positions and headings of its poses."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_planner.any_angle import line_costs
from nav2_planner.grid_graph import FloatGrid
import numpy as np
import numpy.typing as npt
from scipy.linalg import solve_banded

__all__ = ['Rounding', 'blend_headings', 'headings', 'resample', 'round_corners', 'smoothed']

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Rounding:
    """Parameters of corner rounding: the weights of `smoothed`, and the iterations."""

    smooth: float
    data: float
    times: int = 1


def resample(points: FloatArray, spacing: float) -> FloatArray:
    """
    Resample lines so that neighbouring points are no farther apart than a spacing.

    Parameters
    ----------
    points
        (N, 2) corners, which are kept.
    spacing
        The maximum distance, in the unit of the points.

    """
    if len(points) < 2:
        return points
    apart = np.diff(points, axis=0)
    parts = np.maximum(np.ceil(np.hypot(*apart.T) / spacing - 1e-9), 1).astype(np.intp)
    line = np.repeat(np.arange(len(apart)), parts)
    step = np.arange(len(line)) - np.repeat(np.cumsum(parts) - parts, parts)
    inner = points[line] + apart[line] * (step / parts[line])[:, None]
    return np.concatenate([inner, points[-1:]])


def smoothed(points: FloatArray, smooth: float, data: float) -> FloatArray:
    """
    Smooth points: balance straightness against the deviation from the input; the ends are fixed.

    Parameters
    ----------
    points
        (N, 2) points.
    smooth, data
        The weights of both. The range of influence is about sqrt(smooth / data) points.

    Notes
    -----
    The limit of the iteration p += data (p0 - p) + smooth (before + after - 2 p), which is the
    solution of a tridiagonal system of linear equations.

    """
    count = len(points)
    if count < 3 or smooth <= 0.0:
        return np.array(points)
    bands = np.zeros((3, count))
    bands[1] = 1.0
    right = points.astype(np.float64)
    if data > 0.0:
        right[1:-1] *= data
    else:
        right[1:-1] = 0.0
    bands[1, 1:-1] = data + 2.0 * smooth
    bands[0, 2:] = bands[2, :-2] = -smooth
    return np.asarray(solve_banded((1, 1), bands, right))


def round_corners(
    points: FloatArray, weights: FloatGrid, smooth: float, data: float, times: int = 1
) -> FloatArray:
    """
    Smooth a path in a grid where it stays off cells of infinite weight.

    Parameters
    ----------
    points
        (N, 2) rows and columns, about a cell apart.
    weights
        (rows, columns) weights of cells.
    smooth, data, times
        The weights of `smoothed`, and how often it is applied.

    Returns
    -------
    (N, 2) points. Near obstacles that it would touch, they are unchanged.

    """
    wanted = points
    for _ in range(times):
        wanted = smoothed(wanted, smooth, data)
    share = np.ones(len(points))
    for _ in range(4):
        tried = points + share[:, None] * (wanted - points)
        blocked = np.isinf(line_costs(weights, tried[:-1], tried[1:]))
        if not blocked.any():
            return tried
        # Restore the points near a blocked line.
        near = np.convolve(blocked, np.ones(9), 'full')[slice(3, 3 + len(points))] > 0
        share = np.where(near, share * 0.4, share)
        share[near & (share < 0.1)] = 0.0
    tried = points + share[:, None] * (wanted - points)
    blocked = np.isinf(line_costs(weights, tried[:-1], tried[1:]))
    return points if blocked.any() else tried


def headings(points: FloatArray, last: float | None = None) -> FloatArray:
    """
    Compute the (N,) yaws in rad along a path.

    Parameters
    ----------
    points
        (N, 2) x and y.
    last
        The yaw at the end; by default the direction in which the path ends.

    """
    if len(points) < 2:
        return np.full(len(points), 0.0 if last is None else last)
    apart = np.diff(points, axis=0)
    yaws = np.arctan2(apart[:, 1], apart[:, 0])
    still = np.hypot(*apart.T) < 1e-9
    if still.any() and not still.all():
        moving = np.flatnonzero(~still)
        place = np.searchsorted(moving, np.arange(len(yaws)))
        yaws = yaws[moving[np.minimum(place, len(moving) - 1)]]
    return np.append(yaws, yaws[-1] if last is None else last)


def blend_headings(
    points: FloatArray, yaws: FloatArray, first: float, last: float, radius: float
) -> FloatArray:
    """
    Blend headings from a yaw at the start to that of the path, and to another one at the end.

    Parameters
    ----------
    points, yaws
        (N, 2) x and y in m, and (N,) yaws in rad of a path.
    first, last
        The yaws at the ends in rad.
    radius
        The distance in m of a turn by one radian, if the path is long enough.

    """
    if len(points) < 2:
        return np.full(len(points), last, float)
    ways = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    result = np.array(yaws)
    for distance, yaw in ((ways, first), (ways[-1] - ways, last)):
        turn = (yaw - result + np.pi) % (2.0 * np.pi) - np.pi
        reach = min(max(radius * float(np.abs(turn).max()), 1e-9), 0.5 * float(ways[-1]) + 1e-9)
        result += turn * np.clip(1.0 - distance / reach, 0.0, 1.0)
    return result
