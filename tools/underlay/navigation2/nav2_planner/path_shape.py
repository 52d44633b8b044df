# SPDX-License-Identifier: Apache-2.0
"""The shape of a path: straight lines in any direction, rounded corners, and headings."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_planner.grid_graph import FloatGrid
import numpy as np
import numpy.typing as npt
from scipy.linalg import solve_banded

__all__ = [
    'Rounding',
    'blend_headings',
    'headings',
    'line_costs',
    'pull_taut',
    'resample',
    'round_corners',
    'smoothed',
]

FloatArray = npt.NDArray[np.float64]

_SPANS = (1, 2, 3, 5, 8, 13, 21, 34)
_PER_VERTEX = 1e-3
_TIE = 1e-6


def line_costs(weights: FloatGrid, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """
    Compute the costs of straight lines; infinite where one touches a cell of infinite weight.

    Parameters
    ----------
    weights
        (rows, columns) cost of a cell's length in a cell.
    starts, ends
        (M, 2) rows and columns of the ends; centres of cells are integers. All within the grid.

    Returns
    -------
    (M,) lengths in cells times the weights along the line.

    Notes
    -----
    Between two lines of cells across the main direction, the point on their border determines the
    two touched cells; where it is a corner of four cells, all four count as touched.

    """
    apart = ends - starts
    along = (np.abs(apart[:, 1]) > np.abs(apart[:, 0])).astype(np.intp)
    pick = np.arange(len(starts))
    begin, end = starts[pick, along], ends[pick, along]
    direction = np.where(end >= begin, 1, -1)
    first = np.rint(begin)
    borders = np.abs(np.rint(end) - first).astype(np.intp)
    slope = apart[pick, 1 - along] / np.where(end == begin, 1.0, end - begin)

    line = np.repeat(pick, borders)
    step = np.arange(len(line)) - np.repeat(np.cumsum(borders) - borders, borders)
    # Cells as indices of the flattened grid; the stride of a row is the number of columns.
    flat, columns = weights.ravel(), weights.shape[1]
    ahead, aside = np.where(along, 1, columns), np.where(along, columns, 1)
    base = (starts[pick, 1 - along] + slope * (first + 0.5 * direction - begin))[line]
    across = base + (slope * direction)[line] * step
    low = np.rint(across - _TIE).astype(np.intp)
    at_corner = np.flatnonzero(np.rint(across + _TIE) > low)
    stride = (ahead * direction)[line]
    cell = (first.astype(np.intp) * ahead)[line] + stride * step + aside[line] * low
    total = flat[cell] + flat[cell + stride]
    total *= 2.0
    if len(at_corner):
        beside = (cell + aside[line])[at_corner]
        total[at_corner] *= 0.5
        total[at_corner] += flat[beside] + flat[beside + stride[at_corner]]
    sums = np.bincount(line, 0.25 * total, len(starts))
    tips = _at(weights, *np.rint(starts).T) + _at(weights, *np.rint(ends).T)
    mean = np.where(borders > 0, sums / np.maximum(borders, 1), 0.5 * tips)
    costs: npt.NDArray[np.float64] = np.hypot(apart[:, 0], apart[:, 1]) * np.where(
        tips < np.inf, mean, 1.0
    )
    costs[np.isinf(tips)] = np.inf
    return costs


def pull_taut(weights: FloatGrid, way: npt.NDArray[np.int32]) -> FloatArray:
    """
    Replace stretches of a path by straight lines where that costs no more.

    Parameters
    ----------
    weights
        As for `line_costs`.
    way
        (N, 2) rows and columns of cells, each adjacent to the next.

    Returns
    -------
    (M, 2) corners of the lines, with the same ends.

    """
    points = way.astype(np.float64)
    if len(points) < 3:
        return points
    stride = max(1, min(4, len(points) // 250))
    kept = np.append(np.arange(0, len(points) - 1, stride), len(points) - 1)
    points = _choose(weights, points, kept, _SPANS)
    return _choose(weights, points, np.arange(len(points)), tuple(range(1, 9)))


def _choose(
    weights: FloatGrid, points: FloatArray, kept: npt.NDArray[np.intp], spans: tuple[int, ...]
) -> FloatArray:
    """Choose the cheapest chain of lines between candidate points, in order."""
    steps = line_costs(weights, points[:-1], points[1:])
    so_far = np.concatenate([[0.0], np.cumsum(steps)])[kept]
    count = len(kept)
    costs = np.full((len(spans), count), np.inf)
    for row, span in zip(costs, spans):
        if span < count:
            row[span:] = line_costs(weights, points[kept[:-span]], points[kept[span:]])
    # From one to the next, the original path is always available.
    old = np.append(0.0, np.diff(so_far))
    is_old = old < costs[0] - 1e-9
    costs[0] = np.where(is_old, old, costs[0])
    best, before = [0.0], [0]
    table = (costs + _PER_VERTEX).T.tolist()
    for index in range(1, count):
        least, origin = np.inf, index - 1
        for span, cost in zip(spans, table[index]):
            if span > index:
                break
            found = best[index - span] + cost
            if found < least:
                least, origin = found, index - span
        best.append(least)
        before.append(origin)
    chain, index = [int(kept[-1])], count - 1
    while index > 0:
        origin = before[index]
        if origin == index - 1 and is_old[index]:
            chain.extend(range(int(kept[index]) - 1, int(kept[origin]), -1))
        chain.append(int(kept[origin]))
        index = origin
    return points[chain[::-1]]


def _at(
    weights: FloatGrid, rows: npt.NDArray[np.float64], columns: npt.NDArray[np.float64]
) -> npt.NDArray[np.float32]:
    return weights[rows.astype(np.intp), columns.astype(np.intp)]


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
