# SPDX-License-Identifier: Apache-2.0
"""Test the optimal assignment."""

from __future__ import annotations

import itertools

from humanoid_perception.association import assign
import numpy as np
import pytest


def total(costs: np.ndarray, pairs: list[tuple[int, int]], unassigned: float) -> float:
    """Return what an assignment costs."""
    return sum(costs[pair] for pair in pairs) + unassigned * (len(costs) - len(pairs))


def least(costs: np.ndarray, unassigned: float) -> float:
    """Return the least cost, by trying all."""
    rows, columns = costs.shape
    choices = [*range(columns), *([None] * rows)]
    return min(
        sum(unassigned if column is None else costs[row, column] for row, column in enumerate(way))
        for way in itertools.permutations(choices, rows)
    )


@pytest.mark.parametrize('seed', range(60))
def test_no_assignment_is_cheaper(seed: int) -> None:
    """Of all that there are, with pairs that cannot be among them."""
    random = np.random.default_rng(seed)
    costs = random.uniform(0.0, 10.0, random.integers(1, 5, size=2))
    costs[random.random(costs.shape) < 0.3] = np.inf
    unassigned = random.uniform(1.0, 9.0)
    pairs = assign(costs, unassigned)
    assert len({row for row, _ in pairs}) == len({column for _, column in pairs}) == len(pairs)
    assert total(costs, pairs, unassigned) == pytest.approx(least(costs, unassigned))


def test_the_nearest_is_left_to_whom_it_belongs() -> None:
    """Taking the cheapest pair first would leave a dear one."""
    assert assign(np.array([[1.0, 2.0], [1.1, 9.0]]), 20.0) == [(0, 1), (1, 0)]


@pytest.mark.parametrize('shape', [(0, 0), (0, 3), (3, 0)])
def test_nothing_is_paired_with_nothing(shape: tuple[int, int]) -> None:
    """An empty table has no pairs."""
    assert assign(np.zeros(shape), 1.0) == []


def test_what_is_too_dear_stays_alone() -> None:
    """A row is rather left without a column."""
    assert assign(np.array([[5.0]]), 4.0) == []
    assert assign(np.array([[np.inf]]), 4.0) == []


def test_a_cost_that_is_no_number_is_refused() -> None:
    """It would make any assignment the best."""
    with pytest.raises(ValueError, match='NaN'):
        assign(np.array([[float('nan')]]), 1.0)
