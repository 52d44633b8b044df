# SPDX-License-Identifier: Apache-2.0
"""Check that a new owner makes no joint jump."""

from __future__ import annotations

from humanoid_control.backends import JointTargets
from humanoid_control.controllers.manager import Blend, BLEND_S
from humanoid_control.testing import targets
import numpy as np
import pytest

ALL = np.array([True, True, True])
LAST = JointTargets(np.array([0.5, -0.5, 0.0]), np.array([1.0, 0.0, 0.0]), np.full(3, 4.0))


def test_begins_where_it_was_and_ends_at_the_new() -> None:
    """Position, velocity and effort begin with what was told last, and end with the new."""
    blend = Blend(3)
    new = targets(0.2, 0.2, 0.2, velocity_rad_s=0.3)
    blend.begin(ALL, 10.0, LAST, new)
    first = blend.blended(10.0, new)
    assert first.positions_rad == pytest.approx(LAST.positions_rad)
    assert first.velocities_rad_s == pytest.approx(LAST.velocities_rad_s)
    assert first.efforts_nm == pytest.approx(LAST.efforts_nm)
    assert blend.blended(10.0 + BLEND_S, new) is new
    late = blend.blended(10.0 + BLEND_S - 1e-6, new)
    assert late.positions_rad == pytest.approx(new.positions_rad, abs=1e-9)


def test_velocity_is_the_derivative() -> None:
    """The velocity that is told is that of the positions that are told."""
    blend, new = Blend(3), targets(0.2, 0.2, 0.2)
    blend.begin(ALL, 0.0, LAST, new)
    for now_s in np.linspace(0.01, 0.49, 20):
        before, at, after = (blend.blended(now_s + step, new) for step in (-1e-5, 0.0, 1e-5))
        slope = (after.positions_rad - before.positions_rad) / 2e-5
        assert at.velocities_rad_s == pytest.approx(slope, abs=1e-6)


def test_others_are_left_alone() -> None:
    """Joints whose owner stays are told what it says."""
    blend, new = Blend(3), targets(0.2, 0.2, 0.2)
    blend.begin(np.array([True, False, False]), 0.0, LAST, new)
    assert blend.blended(0.1, new).positions_rad[1:].tolist() == [0.2, 0.2]


def test_second_change_goes_on_with_the_first() -> None:
    """Joints that change at different times are blended each in its own time."""
    blend, new = Blend(3), targets(0.2, 0.2, 0.2)
    blend.begin(np.array([True, False, False]), 0.0, LAST, new)
    blend.begin(np.array([False, True, False]), 0.4, LAST, new)
    mixed = blend.blended(0.6, new).positions_rad
    assert mixed[0] == 0.2 and mixed[1] < 0.19
