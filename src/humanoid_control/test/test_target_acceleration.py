# SPDX-License-Identifier: Apache-2.0
"""Check the accelerations of the joints' targets."""

from __future__ import annotations

from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.target_acceleration import TargetAcceleration, within
import numpy as np
import pytest

P = WalkParameters()


@pytest.mark.parametrize('step_s', [0.005, 0.01, 0.1])
def test_even_acceleration(step_s: float) -> None:
    """Velocities that grow evenly get their acceleration, at any rate."""
    acceleration, slope = TargetAcceleration(P), np.array([0.5, -2.0])
    for tick in range(200):
        found = acceleration.update(slope * step_s * tick, step_s)
    assert found == pytest.approx(slope, abs=1e-6)


def test_the_first_one_is_zero() -> None:
    """One velocity says nothing of accelerations."""
    assert TargetAcceleration(P).update(np.array([3.0]), 0.0) == 0.0


def test_a_jump_is_limited() -> None:
    """A velocity that jumps asks for no acceleration beyond the limit."""
    acceleration = TargetAcceleration(P)
    acceleration.update(np.zeros(1), 0.0)
    found = acceleration.update(np.array([100.0]), 0.01)
    assert 0.0 < found[0] <= P.acceleration_limit_rad_s2


def test_the_same_moment_changes_nothing() -> None:
    """A second tick at the same time has no differences."""
    acceleration = TargetAcceleration(P)
    acceleration.update(np.zeros(1), 0.01)
    assert acceleration.update(np.ones(1), 0.0) == 0.0


def test_within() -> None:
    """Values beyond a limit become the limit, on both sides."""
    assert within(np.array([-3.0, 0.5, 2.0]), 1.0).tolist() == [-1.0, 0.5, 1.0]
