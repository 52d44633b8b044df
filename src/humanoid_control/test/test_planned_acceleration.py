# SPDX-License-Identifier: Apache-2.0
"""Check the accelerations of legs and base that make up what is planned."""

from __future__ import annotations

from humanoid_control.dynamics import BodyModel, BodyState
from humanoid_control.walking.inverse_dynamics import (
    leg_maps,
    PlannedAcceleration,
    whole_acceleration,
    within,
)
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import LEFT, RIGHT
from humanoid_control.walking.walking_robot import HomePosture, WalkingRobot
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_rpy
import numpy as np
import pytest

GENERATOR_SEED = 3


@pytest.fixture(name='walking', scope='module')
def _walking(robot: Robot) -> WalkingRobot:
    """Return the robot."""
    drives = load_drives()
    return WalkingRobot.of(robot, drives, tuple(drives))


@pytest.fixture(name='state', scope='module')
def _state(walking: WalkingRobot) -> BodyState:
    """Return the robot in motion near its home posture."""
    generator, n = np.random.default_rng(GENERATOR_SEED), len(walking.body.joints)
    home = HomePosture.of(walking, WalkParameters()).positions_rad
    body: BodyModel = walking.body
    return body.state(
        from_rpy(0.05, -0.1, 0.4),
        generator.normal(size=3),
        home + generator.uniform(-0.2, 0.2, n),
        generator.normal(size=n),
    )


def spatial_jacobian(state: BodyState, link: str) -> np.ndarray:
    """Return the Jacobian (6, 6 + n) of a link."""
    return np.vstack([state.jacobian(link), state.angular_jacobian(link)])


def test_plan_is_kept(walking: WalkingRobot, state: BodyState) -> None:
    """Centre of mass, base and soles are accelerated as planned."""
    generator, n = np.random.default_rng(GENERATOR_SEED), len(walking.body.joints)
    swinging, still = generator.normal(size=6), np.zeros(6)
    arms = np.zeros(n)
    arms[walking.index('left_shoulder')] = 4.0
    plan = PlannedAcceleration(
        np.array([0.5, -0.8, 0.0]), np.array([1.0, 2.0, -1.0]), (swinging, still), arms
    )
    maps = leg_maps(walking.legs, state)
    base, joints = whole_acceleration(state, maps, plan, 1e3)
    accelerations = np.append(base, joints)
    com = state.com_jacobian @ accelerations + state.com_drift_m_s2
    assert com == pytest.approx(plan.com_m_s2, abs=1e-6)
    assert base[3:] == pytest.approx(plan.turn_rad_s2)
    for side, sole in ((LEFT, swinging), (RIGHT, still)):
        link = walking.legs[side].sole
        found = spatial_jacobian(state, link) @ accelerations + state.drift(link)
        assert found == pytest.approx(sole, abs=0.15)
    assert joints[walking.index('left_shoulder')] == 4.0


def test_joints_are_limited(walking: WalkingRobot, state: BodyState) -> None:
    """A sole that is told to jump does not ask for more than the limit."""
    maps = leg_maps(walking.legs, state)
    jump = np.array([0.0, 0.0, 1e5, 0.0, 0.0, 0.0])
    plan = PlannedAcceleration(
        np.zeros(3), np.zeros(3), (jump, np.zeros(6)), np.zeros(len(walking.body.joints))
    )
    _, joints = whole_acceleration(state, maps, plan, 100.0)
    assert np.abs(joints).max() == pytest.approx(100.0)


def test_a_stretched_leg_stays_finite(walking: WalkingRobot) -> None:
    """Where the knee is straight the map gives up a little, but asks nothing endless."""
    n = len(walking.body.joints)
    straight = walking.body.state(np.eye(3), np.zeros(3), np.zeros(n), np.zeros(n))
    lift = np.array([0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
    asked = leg_maps(walking.legs, straight)[LEFT].accelerations(lift, np.zeros(6))
    assert np.isfinite(asked).all()
    assert np.abs(asked).max() < 200.0


def test_within() -> None:
    """Values beyond a limit become the limit, on both sides."""
    assert within(np.array([-3.0, 0.5, 2.0]), 1.0).tolist() == [-1.0, 0.5, 1.0]
