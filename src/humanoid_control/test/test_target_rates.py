# SPDX-License-Identifier: Apache-2.0
"""Check the velocities and accelerations of the joints' targets."""

from __future__ import annotations

from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.target_rates import TargetRates
import numpy as np
import pytest

P = WalkParameters()


@pytest.mark.parametrize('step_s', [0.005, 0.01, 0.1])
def test_even_motion(step_s: float) -> None:
    """Targets that move evenly get their velocity, and no acceleration, at any rate."""
    rates, speed = TargetRates(P, 2), np.array([0.5, -2.0])
    for tick in range(40):
        rates.update(speed * step_s * tick, step_s)
    assert rates.velocities_rad_s == pytest.approx(speed, abs=1e-6)
    assert rates.accelerations_rad_s2 == pytest.approx(0, abs=1e-3)


def test_first_targets_are_at_rest() -> None:
    """One tick says nothing of velocities."""
    rates = TargetRates(P, 1)
    rates.update(np.array([3.0]), 0.0)
    assert rates.velocities_rad_s == rates.accelerations_rad_s2 == 0.0


def test_a_jump_is_limited() -> None:
    """A target that jumps asks for no velocity beyond the limit."""
    rates = TargetRates(P, 1)
    rates.update(np.zeros(1), 0.0)
    rates.update(np.array([100.0]), 0.01)
    assert 0.0 < rates.velocities_rad_s[0] <= P.velocity_limit_rad_s
    assert 0.0 < rates.accelerations_rad_s2[0] <= P.acceleration_limit_rad_s2


def test_the_same_moment_changes_nothing() -> None:
    """A second tick at the same time has no differences."""
    rates = TargetRates(P, 1)
    rates.update(np.zeros(1), 0.01)
    rates.update(np.ones(1), 0.0)
    assert rates.velocities_rad_s == 0.0
