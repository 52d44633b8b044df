# SPDX-License-Identifier: Apache-2.0
"""Check the efforts that carry the robot, and what the ground has to do."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics import BodyState
from humanoid_control.walking.footing import Footing, GroundReaction, Loads, loads_for
from humanoid_control.walking.inverse_dynamics import ground_efforts, hip_efforts
from humanoid_control.walking.odometry import base_on
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import GRAVITY_M_S2
from humanoid_control.walking.planar import SIDES, Turning
from humanoid_control.walking.support_polygon import FootShape, SupportPolygon
from humanoid_control.walking.terrain import footing_below
from humanoid_control.walking.walking_robot import Attitude, HomePosture, RobotState, WalkingRobot
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_rpy
import numpy as np
import pytest

P = WalkParameters()
UNDRAGGED = (0j, 0j)
BASE = np.array([0.3, -0.2, 0.65])
FORCE = np.array([20.0, -10.0, 400.0])


@dataclass(frozen=True, eq=False)
class Stance:
    """A robot that stands at home."""

    robot: WalkingRobot
    home: HomePosture
    state: BodyState
    footing: Footing
    loads: Loads

    @property
    def base_m(self) -> np.ndarray:
        """Return where the base is."""
        return np.array([0.0, 0.0, self.home.base_height_m])


@pytest.fixture(name='stance', scope='module')
def _stance(robot: Robot) -> Stance:
    """Return a robot that stands at home, its base above the origin."""
    drives = load_drives()
    walking = WalkingRobot.of(robot, drives, tuple(drives))
    home = HomePosture.of(walking, P)
    still = np.zeros(len(drives))
    state = walking.body.state(np.eye(3), np.zeros(3), home.positions_rad, still)
    level = Attitude(0.0, 0.0, 0.0, (0.0, 0.0, 0.0))
    sensed = RobotState(0.0, state, level, (0.5, 0.5), UNDRAGGED, still, np.zeros(3))
    footing = footing_below(0j, walking, FootShape.of(robot, P.posture), P, sensed)
    return Stance(walking, home, state, footing, loads_for(footing, SIDES, footing.rest_point))


def standing_efforts(stance: Stance) -> np.ndarray:
    """Return the efforts of a robot that stands still."""
    reaction = GroundReaction.of(stance.state.bias_wrench, stance.base_m)
    loads = loads_for(stance.footing, SIDES, reaction.point_m)
    on_joints = ground_efforts(stance.robot, stance.state, stance.base_m, loads, reaction)
    efforts: np.ndarray = stance.state.bias_nm - on_joints
    return efforts


def test_ground_carries_all(stance: Stance) -> None:
    """At rest the ground carries the weight, below the centre of mass, and turns nothing."""
    reaction = GroundReaction.of(stance.state.bias_wrench, stance.base_m)
    weight_n = stance.robot.body.mass_kg * GRAVITY_M_S2
    assert reaction.force_n == pytest.approx([0.0, 0.0, weight_n])
    com = stance.state.com_m
    assert reaction.point_m == pytest.approx(complex(com[0], com[1]))
    assert reaction.turn_nm == pytest.approx(0.0, abs=1e-9)


def test_ankles_carry_the_load_before_them(stance: Stance) -> None:
    """An ankle holds the ground's force at its lever, less the weight of the foot."""
    efforts = standing_efforts(stance)
    half_weight_n = stance.robot.body.mass_kg * GRAVITY_M_S2 / 2
    foot_kg, foot_forward_m = 1.0, 0.025
    expected = half_weight_n * P.posture.zmp_forward_m - foot_kg * GRAVITY_M_S2 * foot_forward_m
    for side in SIDES:
        pitch = stance.robot.legs[side].indices[4]
        assert efforts[pitch] == pytest.approx(expected, abs=1e-3)


def test_efforts_mirror_each_other(stance: Stance) -> None:
    """A robot that stands on both feet pushes alike with both legs."""
    efforts = standing_efforts(stance)
    left, right = (efforts[stance.robot.legs[side].indices] for side in SIDES)
    assert left == pytest.approx(right * [-1, -1, 1, 1, 1, -1], abs=1e-6)


@pytest.mark.parametrize('rpy', [(0.0, 0.0, 0.0), (0.05, -0.1, 0.4)])
@pytest.mark.parametrize('shares', [(1.0, 0.0), (0.0, 1.0), (0.3, 0.7)])
def test_base_is_above_feet_that_stand(
    stance: Stance, rpy: tuple[float, float, float], shares: tuple[float, float]
) -> None:
    """The base is where it makes the loaded soles be where they landed, and moves with them."""
    rates = np.array([0.1, 0.2, -0.3])
    body = stance.robot.body
    moving = np.linspace(-0.2, 0.2, len(stance.home.positions_rad))
    state = body.state(from_rpy(*rpy), rates, stance.home.positions_rad, moving)
    soles = [leg.sole for leg in stance.robot.legs]
    base = base_on(stance.footing, shares, soles, state)
    place, speed = np.zeros(3), np.zeros(3)
    for share, leg, side in zip(shares, stance.robot.legs, SIDES):
        point = stance.footing.pose(side).position_m
        anchor = np.array([point.real, point.imag, 0.0])
        place += share * (base.position_m + state.position_m(leg.sole) - anchor)
        speed += share * (base.velocity_m_s + state.velocity_m_s(leg.sole))
    assert place == pytest.approx(np.zeros(3), abs=1e-12)
    assert speed == pytest.approx(np.zeros(3), abs=1e-12)


def test_hips_turn_the_pelvis_back(stance: Stance) -> None:
    """A pelvis that leans is pushed upright; a leg on the ground turns it the other way."""
    upright = hip_efforts(P, Attitude(0.0, 0.0, 0.3, (0.0, 0.0, 0.2)), Turning(0.3, 0.2))
    assert upright == pytest.approx(0.0)
    leaning = hip_efforts(P, Attitude(0.02, -0.03, 0.4, (0.1, 0.0, 0.0)), Turning(0.3))
    yaw, roll, pitch = leaning
    assert yaw > 0.0
    assert roll > P.balance.attitude_stiffness_nm_rad * 0.02
    assert pitch < 0.0


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
