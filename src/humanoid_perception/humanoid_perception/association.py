# SPDX-License-Identifier: Apache-2.0
"""Data association of detections and remembered objects: an optimal assignment."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ['assign']

Array = npt.NDArray[np.float64]


def assign(costs: Array, unassigned_cost: float) -> list[tuple[int, int]]:
    """
    Assign columns to rows with the least sum of costs.

    Parameters
    ----------
    costs
        The costs (R, C); infinite where a row and a column cannot be paired.
    unassigned_cost
        The cost of a row without a column; pairs that cost more are not made.

    Returns
    -------
    list of tuple
        Pairs of row and column, ordered by row; each row and each column at most once.

    Raises
    ------
    ValueError
        A cost is NaN.

    Notes
    -----
    The Hungarian method with shortest augmenting paths (Jonker and Volgenant, 1987), in which
    every row has a dummy column of its own for no assignment.

    """
    costs = np.asarray(costs, dtype=float)
    rows, columns = costs.shape
    if np.isnan(costs).any():
        raise ValueError('A cost of the assignment is NaN.')
    if not rows or not columns:
        return []
    # Infinite costs would make paths incomparable.
    never = 1e3 * (abs(unassigned_cost) + 1.0) * (rows + columns)
    table = np.full((rows, columns + rows), never)
    table[:, :columns] = np.where(costs > unassigned_cost, never, costs)
    table[np.arange(rows), columns + np.arange(rows)] = unassigned_cost
    chosen = _columns_of_rows(table)
    return [(row, int(column)) for row, column in enumerate(chosen) if column < columns]


def _columns_of_rows(table: Array) -> npt.NDArray[np.intp]:
    """Solve the assignment of a table with at least as many columns as rows: a column per row."""
    rows, columns = table.shape
    row_price, column_price = np.zeros(rows), np.zeros(columns)
    row_of = np.full(columns, -1)
    for row in range(rows):
        reach = np.full(columns, np.inf)
        before = np.full(columns, -1)
        is_done = np.zeros(columns, dtype=bool)
        current, at, length = row, -1, 0.0
        while True:
            step = length + table[current] - row_price[current] - column_price
            is_shorter = ~is_done & (step < reach)
            reach[is_shorter], before[is_shorter] = step[is_shorter], at
            at = int(np.argmin(np.where(is_done, np.inf, reach)))
            is_done[at], length = True, float(reach[at])
            if row_of[at] < 0:
                break
            current = int(row_of[at])
        ways = np.flatnonzero(is_done)
        for column in ways:
            if row_of[column] >= 0:
                row_price[row_of[column]] += length - reach[column]
        row_price[row] += length
        column_price[ways] -= length - reach[ways]
        while at >= 0:
            previous = int(before[at])
            row_of[at] = row if previous < 0 else row_of[previous]
            at = previous
    chosen = np.zeros(rows, dtype=np.intp)
    taken = np.flatnonzero(row_of >= 0)
    chosen[row_of[taken]] = taken
    return chosen
