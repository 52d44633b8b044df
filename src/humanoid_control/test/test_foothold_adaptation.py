# SPDX-License-Identifier: Apache-2.0
"""Check how feet give way to the ground."""

from __future__ import annotations

from humanoid_control.walking import WalkParameters
from humanoid_control.walking.footing import Foothold, Footing, SoleReading
from humanoid_control.walking.gait_parameters import PostureParameters
from humanoid_control.walking.planar import GroundPlane, LEFT, PlanarPose, RIGHT
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.terrain import FootholdAdaptation
from humanoid_description.robot import Robot
import pytest

TILTED = GroundPlane(0.01, 0.05 + 0.02j)


@pytest.fixture(name='footing')
def _footing(robot: Robot) -> Footing:
    """Return feet that were told to stand level."""
    feet = [Foothold(PlanarPose(0.09j)), Foothold(PlanarPose(-0.09j))]
    return Footing(FootShape.of(robot, PostureParameters()), feet)


def conformed(
    footing: Footing, load: float, shares: tuple[float, float], in_air: int | None, seconds: float
) -> Footing:
    """Return the feet after a time in which both soles were measured tilted, and so much load."""
    adaptation = FootholdAdaptation(WalkParameters())
    for _ in range(round(seconds / 0.01)):
        left, right = (SoleReading(footing.pose(side), TILTED, load) for side in (LEFT, RIGHT))
        adaptation.update(footing, (left, right), shares, in_air, 0.01)
    return footing


def test_loaded_feet_take_over_tilt_and_height(footing: Footing) -> None:
    """In the end they are told to be as they are."""
    conformed(footing, 0.5, (0.5, 0.5), None, 2.0)
    for side in (LEFT, RIGHT):
        assert footing[side].plane.tilt == pytest.approx(TILTED.tilt, abs=1e-4)
        assert footing[side].plane.height_m == pytest.approx(TILTED.height_m, abs=1e-4)


def test_a_foot_without_weight_is_not_turned(footing: Footing) -> None:
    """Nothing but the robot itself tilts it; but it is pressed down."""
    conformed(footing, 0.0, (0.0, 1.0), None, 0.2)
    assert footing[LEFT].plane.tilt == 0j
    assert footing[LEFT].plane.height_m < TILTED.height_m


def test_a_foot_in_the_air_is_left_alone(footing: Footing) -> None:
    """It will conform when it has landed."""
    conformed(footing, 0.5, (0.0, 1.0), LEFT, 1.0)
    assert footing[LEFT].plane == GroundPlane()
    assert footing[RIGHT].plane.tilt == pytest.approx(TILTED.tilt, abs=1e-3)


def test_the_foot_that_carries_all_keeps_its_height(footing: Footing) -> None:
    """It is what heights are measured from."""
    conformed(footing, 1.0, (1.0, 0.0), RIGHT, 1.0)
    assert footing[LEFT].plane.height_m == 0.0
