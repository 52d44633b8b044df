# SPDX-License-Identifier: Apache-2.0
"""Check what the ground has to do."""

from __future__ import annotations

from humanoid_control.walking.ground_reaction import GroundReaction
from humanoid_control.walking.support_polygon import SupportPolygon
import numpy as np
import pytest

BASE = np.array([0.3, -0.2, 0.65])
FORCE = np.array([20.0, -10.0, 400.0])


def wrench_of(point: complex, turn_nm: float) -> np.ndarray:
    """Return the wrench on the base of a force at a point of the ground and a torque there."""
    lever = np.array([point.real, point.imag, 0.0]) - BASE
    return np.append(FORCE, np.cross(lever, FORCE) + [0.0, 0.0, turn_nm])


def test_point_and_torque_are_found() -> None:
    """A force at a point of the ground and a torque about the vertical are found again."""
    reaction = GroundReaction.of(wrench_of(0.35 - 0.1j, 3.0), BASE)
    assert reaction.force_n == pytest.approx(FORCE)
    assert reaction.point_m == pytest.approx(0.35 - 0.1j)
    assert reaction.turn_nm == pytest.approx(3.0)


def test_feet_can_do_only_so_much() -> None:
    """The point is brought below the feet and the torque limited; the force stays."""
    square = SupportPolygon([0j, 0.1 + 0j, 0.1 + 0.1j, 0.1j])
    cut = GroundReaction(FORCE, 0.2 + 0.05j, -9.0).within(square, 5.0)
    assert cut.point_m == pytest.approx(0.1 + 0.05j)
    assert cut.turn_nm == -5.0
    assert cut.force_n is FORCE
