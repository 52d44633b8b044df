# SPDX-License-Identifier: Apache-2.0
"""Which detection belongs to which remembered object, and which objects are the same one."""

from __future__ import annotations

from collections.abc import Sequence
import math

from humanoid_perception.remembered import RememberedThing
from humanoid_perception.sighting import Sighting
import numpy as np
import numpy.typing as npt

__all__ = ['assign', 'associate', 'has_moved', 'is_same']

Array = npt.NDArray[np.float64]

_GATE = 16.0
"""Largest cost of a pair: chi-square with three degrees of freedom at 99.9 %."""
_FAR_M = 2.0
"""Distance from an object beyond which no detection can belong to it."""


def associate(
    sightings: Sequence[Sighting],
    noises_m2: Sequence[Array],
    things: Sequence[RememberedThing],
    doubts_m2: Sequence[Array],
) -> list[tuple[int, int]]:
    """
    Associate detections with objects.

    Parameters
    ----------
    sightings, noises_m2
        The detections, and the covariances (3, 3) of their positions.
    things, doubts_m2
        The objects, and the covariances (3, 3) that are added to those of their positions.

    Returns
    -------
    list of tuple
        Pairs of the index of a detection and of an object, ordered by detection; each detection
        and each object at most once.

    """
    return assign(_costs(sightings, noises_m2, things, doubts_m2), _GATE)


def _costs(
    sightings: Sequence[Sighting],
    noises_m2: Sequence[Array],
    things: Sequence[RememberedThing],
    doubts_m2: Sequence[Array],
) -> Array:
    """Compute the association costs (detections, objects)."""
    costs = np.full((len(sightings), len(things)), np.inf)
    if not costs.size:
        return costs
    places = np.array([thing.position_m for thing in things])
    for row, (sighting, noise) in enumerate(zip(sightings, noises_m2, strict=True)):
        away_m = np.linalg.norm(places - sighting.position_m, axis=1)
        for column in np.flatnonzero(away_m < _FAR_M).tolist():
            costs[row, column] = _cost(things[column], sighting, noise + doubts_m2[column])
    return costs


def _cost(thing: RememberedThing, sighting: Sighting, noise_m2: Array) -> float:
    """Compute the cost of associating a detection with an object; infinite if impossible."""
    distance_m = float(np.linalg.norm(sighting.position_m - thing.position_m))
    reach_m = 0.5 * float(max(thing.size_m.max(), sighting.size_m.max()))
    share = thing.classes.share(sighting.class_id)
    near_m = reach_m + (0.6 if share > 0.1 else 0.08)
    if distance_m > near_m:
        return math.inf
    if sighting.is_cut:
        # Its centre is that of the part within the image.
        noise_m2 = noise_m2 + reach_m**2 * np.eye(3)
        size_term = 0.0
    else:
        ratio = math.log(float(sighting.size_m.max() / thing.size_m.max()))
        size_term = min(2.0 * ratio * ratio, 3.0)
    cost = thing.distance2(sighting, noise_m2) + 4.0 * (1.0 - share) + size_term
    if sighting.colour and thing.colours.best:
        cost += 3.0 * (1.0 - thing.colours.share(sighting.colour))
    return cost


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


def is_same(thing: RememberedThing, other: RememberedThing) -> bool:
    """
    Check whether two objects are so close that they must be the same.

    Parameters
    ----------
    thing, other
        The objects.

    """
    distance_m = float(np.linalg.norm(thing.position_m - other.position_m))
    limit_m = 0.5 * float(min(thing.size_m.max(), other.size_m.max()))
    if thing.class_id == other.class_id and (
        thing.colour == other.colour or not thing.colour or not other.colour
    ):
        limit_m += min(2.0 * max(thing.sigma_m, other.sigma_m), 0.15)
    return distance_m < limit_m


def has_moved(old: RememberedThing, new: RememberedThing) -> bool:
    """
    Check whether a new object may be an old one of its kind that has moved.

    Parameters
    ----------
    old, new
        The objects.

    """
    if old.empty >= 2:
        return True
    distance_m = float(np.linalg.norm(old.position_m - new.position_m))
    is_close = distance_m < 2.0 * float(max(old.size_m.max(), new.size_m.max()))
    return is_close and old.missed >= 2
