# SPDX-License-Identifier: Apache-2.0
"""Check what the robot stands on, and how its feet share the weight."""

from __future__ import annotations

from humanoid_control.walking.footing import Foothold, Footing, loads_for
from humanoid_control.walking.gait_parameters import PostureParameters
from humanoid_control.walking.planar import GroundPlane, LEFT, PlanarPose, RIGHT, SIDES
from humanoid_control.walking.support_polygon import FootShape
from humanoid_description.robot import Robot
import numpy as np
import pytest

SHAPE = FootShape(0.115, -0.065, 0.043, -0.043, 0.015 - 0.005j)
FEET = [Foothold(PlanarPose(0.02 + 0.09j, 0.2)), Foothold(PlanarPose(-0.05 - 0.1j, -0.1))]
RANDOM = np.random.default_rng(5)


def test_shape_is_that_of_the_model(robot: Robot) -> None:
    """The area of the sole is the foot's box less the margins."""
    shape = FootShape.of(robot, PostureParameters())
    assert (shape.front_m, shape.back_m) == pytest.approx((0.125, -0.075))
    assert (shape.outer_m, shape.inner_m) == pytest.approx((0.047, -0.047))


def test_feet_mirror_each_other() -> None:
    """The right foot's corners and load point are those of the left one beyond the x axis."""
    pose = PlanarPose()
    left = {point.conjugate() for point in SHAPE.corners(LEFT, pose)}
    assert left == set(SHAPE.corners(RIGHT, pose))
    assert SHAPE.load_point(RIGHT, pose) == SHAPE.load_point(LEFT, pose).conjugate()


def test_one_foot_carries_all() -> None:
    """On one foot all of the weight acts at the zero-moment point."""
    loads = loads_for(Footing(SHAPE, FEET), (RIGHT,), 0.01 - 0.1j)
    assert loads.shares == (0.0, 1.0)
    assert loads.points_m[RIGHT] == 0.01 - 0.1j


def test_loads_make_up_the_zero_moment_point() -> None:
    """Wherever the point is between the feet, the loads' weighted mean is there."""
    footing = Footing(SHAPE, FEET)
    for _ in range(100):
        corners = np.array(footing.polygon().corners)
        zmp = complex(RANDOM.dirichlet(np.ones(len(corners))) @ corners)
        loads = loads_for(footing, SIDES, zmp)
        assert min(loads.shares) >= 0.0
        assert sum(loads.shares) == pytest.approx(1.0)
        mean = sum(share * point for share, point in zip(loads.shares, loads.points_m))
        assert mean == pytest.approx(zmp)


def test_a_new_foothold_moves_the_area() -> None:
    """When a foot lands somewhere else, the area in which it carries goes with it."""
    footing = Footing(SHAPE, FEET)
    inside = footing.load_point(LEFT)
    assert footing.polygon((LEFT,)).contains(inside)
    footing.put(LEFT, Foothold(PlanarPose(1 + 1j)))
    assert not footing.polygon((LEFT,)).contains(inside)
    assert footing.polygon((LEFT,)).contains(footing.load_point(LEFT))


def test_rest_is_between_the_feet() -> None:
    """The weight rests half-way between the load points, inside the area of both feet."""
    footing = Footing(SHAPE, FEET)
    rest = (footing.load_point(LEFT) + footing.load_point(RIGHT)) / 2
    assert footing.rest_point == rest
    assert footing.polygon().contains(rest)
    assert footing.middle.yaw_rad == pytest.approx(0.05)


def test_feet_conform_where_they_stand() -> None:
    """What a foot stands on may change; the feet share heights as they share the weight."""
    footing = Footing(SHAPE, FEET)
    footing.adapt(LEFT, Foothold(FEET[LEFT].pose, GroundPlane(0.02, 0.1j)))
    assert footing.height_m((0.25, 0.75)) == pytest.approx(0.005)
    assert footing.tilt == pytest.approx(0.05j)
    assert footing.pose(LEFT) == FEET[LEFT].pose
