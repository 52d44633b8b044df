# SPDX-License-Identifier: Apache-2.0
"""What makes it hard for a controller."""

from __future__ import annotations

from humanoid_simulation.testing.lockstep_robot import DropOuts
import numpy as np
import pytest


def test_drop_outs_are_as_frequent_and_long_as_set() -> None:
    """They begin with the chance that is set, and last up to the longest."""
    source = DropOuts(np.random.default_rng(0), 0.02, 10)
    missed = np.array([source.misses() for _ in range(20_000)])
    edges = np.flatnonzero(np.diff(np.concatenate([[0], missed, [0]]).astype(int)))
    lengths = np.diff(edges)[::2]
    assert lengths.min() == 1
    assert 10 <= lengths.max() <= 25
    assert missed.mean() == pytest.approx(0.1, abs=0.02)


def test_without_a_chance_nothing_is_missed() -> None:
    """A chance of zero is none."""
    source = DropOuts(np.random.default_rng(0), 0.0, 10)
    assert not any(source.misses() for _ in range(100))
