# SPDX-License-Identifier: Apache-2.0
"""Shorten a path from cell to cell to straight lines in any direction, at no higher cost."""

from __future__ import annotations

from nav2_planner.grid_graph import FloatGrid
import numpy as np
import numpy.typing as npt

__all__ = ['line_costs', 'pull_taut']

Points = npt.NDArray[np.float64]

_SPANS = (1, 2, 3, 5, 8, 13, 21, 34)
_PER_VERTEX = 1e-3
_TIE = 1e-6


def line_costs(weights: FloatGrid, starts: Points, ends: Points) -> npt.NDArray[np.float64]:
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


def pull_taut(weights: FloatGrid, way: npt.NDArray[np.int32]) -> Points:
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
    weights: FloatGrid, points: Points, kept: npt.NDArray[np.intp], spans: tuple[int, ...]
) -> Points:
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
