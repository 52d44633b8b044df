# SPDX-License-Identifier: Apache-2.0
"""What makes it hard for a controller."""

from __future__ import annotations

import math

from humanoid_simulation.disturbances import DropOuts, Latency, push, RandomPushes
import numpy as np
import pytest


def test_a_push_has_an_impulse_and_a_direction() -> None:
    """Force times duration is the impulse; a quarter turn is to the left."""
    pushed = push(15.0, math.pi / 2)
    assert pushed.force_n * pushed.duration_s == pytest.approx([0.0, 15.0, 0.0], abs=1e-9)


def test_pushes_come_at_random_moments_in_all_directions() -> None:
    """Neither too often nor too seldom, the same for a seed."""

    def pushes(seed: int) -> list[tuple[float, float]]:
        source = RandomPushes(np.random.default_rng(seed), 10.0, 1.5, 5.0)
        found = ((tick * 0.01, source.due(tick * 0.01)) for tick in range(60_000))
        return [
            (time_s, math.atan2(pushed.force_n[1], pushed.force_n[0]))
            for time_s, pushed in found
            if pushed
        ]

    times, directions = np.array(pushes(1)).T
    gaps = np.diff(times)
    assert 1.48 < gaps.min() < 2.0
    assert 4.5 < gaps.max() < 5.02
    assert abs(np.exp(1j * directions).mean()) < 0.2
    assert pushes(1) == pushes(1)


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


def test_targets_come_late(hold) -> None:
    """By as many ticks as set; before that nothing comes."""
    latency = Latency(2)
    sent = [hold(np.full(3, float(number))) for number in range(4)]
    assert [latency.through(targets) for targets in sent] == [None, None, sent[0], sent[1]]
