# SPDX-License-Identifier: Apache-2.0
"""Check what is known of the ground."""

from __future__ import annotations

import math

from humanoid_control.walking.planar import GroundPlane, LEFT, other, tilt_of
from humanoid_control.walking.terrain import GroundLevel, LevelFloor
from humanoid_description.rotations import from_rpy
import numpy as np
import pytest


@pytest.mark.parametrize('yaw_rad', [0.0, 1.0, -2.5])
@pytest.mark.parametrize('tilt', [0j, 0.1 + 0j, -0.05 + 0.08j])
def test_a_sole_on_a_facet(tilt: complex, yaw_rad: float) -> None:
    """It lies flat on it, faces the heading, and its tilt is read back."""
    rotation = GroundPlane(0.0, tilt).rotation(yaw_rad)
    assert rotation @ rotation.T == pytest.approx(np.eye(3))
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert tilt_of(rotation, 0.3) == pytest.approx(tilt)
    ahead = complex(rotation[0, 0], rotation[1, 0])
    assert math.atan2(ahead.imag, ahead.real) == pytest.approx(yaw_rad, abs=0.02)


def test_tilt_is_cut() -> None:
    """What is steeper than ground may be is taken for the steepest, in the same direction."""
    cut = tilt_of(from_rpy(0.0, 0.5, 0.0), 0.2)
    assert cut == pytest.approx(math.sin(0.2))


def test_ground_goes_on_beside() -> None:
    """Ground whose water runs ahead is lower there; across it is as high."""
    plane = GroundPlane(0.3)
    assert plane.height_beside(0.1 + 0j, 0.1 + 0j) == pytest.approx(0.29)
    assert plane.height_beside(0.1j, 0.1 + 0j) == pytest.approx(0.3)


def test_level_follows_the_feet() -> None:
    """It ends where they are if nothing is measured against it, whatever the steps of time."""
    for steps in (1, 10):
        level = GroundLevel(6.0, 0.0, 0.1)
        for _ in range(steps):
            level.update(0.02, 0.5, 0.5 / steps)
        assert level.height_m == pytest.approx(0.02 * (1.0 - math.exp(-3.0)))


def test_level_gives_way_to_what_is_measured() -> None:
    """It comes to rest between the height of the feet and that of the centre of mass."""
    level = GroundLevel(6.0, 8.0, 0.1)
    for _ in range(400):
        level.update(0.02, 0.0, 0.01)
    assert 0.0 < level.height_m < 0.02


def test_level_stays_near_the_feet() -> None:
    """A robot that sinks does not take the level of the ground along, however far it sinks."""
    level = GroundLevel(6.0, 8.0, 0.04)
    for sunk_m in (0.1, 0.2, 0.5):
        for _ in range(100):
            level.update(0.02, -sunk_m, 0.01)
        assert level.height_m == pytest.approx(0.02 - 0.04)


def climbed_m(step_m: float, lean_m: float = 0.0, steps: int = 50) -> float:
    """Return how high a robot believes to be after steps of a height, if its sensor leans."""
    floor, heights_m, side = LevelFloor(0.005), [0.0, 0.0], LEFT
    for _ in range(steps):
        floor.update(heights_m, side)
        lean_m = -lean_m
        heights_m[side] = heights_m[other(side)] + step_m + lean_m
        floor.update(heights_m, None)
        side = other(side)
    floor.update(heights_m, side)
    shares = [0.0 if each == side else 1.0 for each in (0, 1)]
    return heights_m[other(side)] + floor.rise_m(shares)


@pytest.mark.parametrize('lean_m', [0.0, 0.004])
@pytest.mark.parametrize('step_m', [-0.002, 0.001])
def test_a_floor_does_not_drift(step_m: float, lean_m: float) -> None:
    """Each foothold seems to be a little higher or lower than the one before, and is not."""
    assert climbed_m(step_m, lean_m) == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize('step_m', [-0.02, 0.01])
def test_stairs_are_climbed(step_m: float) -> None:
    """What is higher by more than that is."""
    assert climbed_m(step_m) == pytest.approx(50 * step_m, abs=0.01)
