# SPDX-License-Identifier: Apache-2.0
"""Check what a robot does when it falls, lies, and is put onto its feet."""

from __future__ import annotations

from dataclasses import replace

from humanoid_control.backends import Observation
from humanoid_control.walking import VelocityCommand, Walker, WalkParameters
from humanoid_control.walking.get_up import Rising
from humanoid_control.walking.recovery import FallDetector, StandingState
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_rpy, quaternion_of
import numpy as np
import pytest

WEIGHT_N = 42.8 * 9.81
UPRIGHT = StandingState(0.0, 0.0, 0.7, 1.0)
DETECTOR = FallDetector(WalkParameters(), 0.7)


@pytest.fixture(name='walker')
def _walker(robot: Robot) -> Walker:
    """Return a walker that has not begun."""
    drives = load_drives()
    return Walker.of(robot, drives, tuple(drives), WalkParameters())


def seen(walker: Walker, time_s: float, pitch_rad: float = 0.0, load: float = 1.0) -> Observation:
    """Return what a robot observes that is at home but leans, so much weight on its feet."""
    home = walker.home.positions_rad
    still = np.zeros(len(home))
    forces = np.array([[0.0, 0.0, load * WEIGHT_N / 2]] * 2)
    orientation = np.array(quaternion_of(from_rpy(0.0, pitch_rad, 0.0)))
    up = np.array([0.0, 0.0, 9.81])
    return Observation(
        time_s, home.copy(), still, still, orientation, np.zeros(3), up, forces, np.zeros((2, 3))
    )


@pytest.mark.parametrize(
    ('stance', 'falls'),
    [
        (UPRIGHT, False),
        (replace(UPRIGHT, tilt_rad=0.3), False),
        (replace(UPRIGHT, tilt_rad=0.1, tilting_rad_s=4.0), False),
        (replace(UPRIGHT, tilt_rad=0.35, tilting_rad_s=2.0), True),
        (replace(UPRIGHT, tilt_rad=0.3, tilting_rad_s=-5.0), False),
        (replace(UPRIGHT, tilt_rad=0.9, tilting_rad_s=-5.0), True),
        (replace(UPRIGHT, height_m=0.3), True),
    ],
)
def test_falls_are_told_from_what_the_walk_survives(stance: StandingState, falls: bool) -> None:
    """Leaning far or fast, or being low, is a fall; righting itself is none."""
    assert DETECTOR.is_falling(stance) is falls


@pytest.mark.parametrize(('pitch_rad', 'rate_rad_s'), [(0.2, 1.5), (-0.2, 1.5), (0.0, 1.5)])
def test_stance_is_measured(walker: Walker, pitch_rad: float, rate_rad_s: float) -> None:
    """Tilt and its rate have the signs that they should, whichever way the robot leans."""
    observation = replace(
        seen(walker, 0.0, pitch_rad), angular_velocity_rad_s=np.array([0.0, rate_rad_s, 3.0])
    )
    stance = StandingState.of(walker.robot, walker._estimator.read(observation))
    assert stance.tilt_rad == pytest.approx(abs(pitch_rad))
    assert stance.tilting_rad_s == pytest.approx(-rate_rad_s if pitch_rad < 0 else rate_rad_s)
    assert stance.height_m == pytest.approx(walker.home.base_height_m, abs=0.1)
    assert stance.load == pytest.approx(1.0, abs=1e-2)


def test_joints_give_way_in_a_fall_and_are_loose_after_it(walker: Walker) -> None:
    """They are pulled a little at first, and not at all in the end."""
    walker.update(seen(walker, 0.0))
    walker.command(VelocityCommand(0.2))
    falling = seen(walker, 0.01, pitch_rad=1.0)
    targets = walker.update(falling)
    assert walker.has_fallen
    assert walker.status is not None
    assert walker.status.phase == 'fallen'
    assert 0.0 < np.abs(targets.positions_rad - falling.positions_rad).max() < 0.4
    assert not targets.velocities_rad_s.any()
    assert not targets.efforts_nm.any()
    lying = seen(walker, 3.0, pitch_rad=1.5)
    assert (walker.update(lying).positions_rad == lying.positions_rad).all()


def test_a_robot_that_lies_is_near_the_ground(walker: Walker) -> None:
    """Its lowest link is on the ground, in odometry as well."""
    walker.update(seen(walker, 0.0))
    walker.update(seen(walker, 0.01, pitch_rad=1.5))
    walker.update(seen(walker, 3.0, pitch_rad=1.5))
    assert walker.status is not None
    assert 0.05 < walker.status.odometry.height_m < 0.3


def test_a_robot_that_lies_from_the_start_has_a_status(walker: Walker) -> None:
    """From the first tick on it says that it has fallen, where it is, and plans nothing."""
    assert walker.phase is None
    walker.update(seen(walker, 0.0, pitch_rad=1.5))
    status = walker.status
    assert status is not None
    assert status.phase == walker.phase == 'fallen'
    assert 0.05 < status.odometry.height_m < 0.3
    assert abs(status.odometry.pose.position_m) < 1.0
    assert (status.support, list(status.footsteps)) == ((), [])
    assert status.zmp_m == status.dcm_m == status.dcm_reference_m


def test_a_robot_that_is_held_upright_stands_up(walker: Walker) -> None:
    """It takes the posture of standing, and stands as soon as its feet carry it."""
    walker.update(seen(walker, 0.0))
    walker.update(seen(walker, 0.01, pitch_rad=1.5))
    phases = []
    for tick in range(300):
        load = 1.0 if tick > 200 else 0.0
        walker.update(seen(walker, 0.02 + 0.01 * tick, load=load))
        assert walker.status is not None
        phases.append(walker.status.phase)
    assert phases[:201] == ['stand_up'] * 201
    assert phases[202:] == ['stand'] * 98


def test_a_robot_that_has_stood_up_does_not_walk_off(walker: Walker) -> None:
    """The velocity of before the fall is forgotten."""
    walker.update(seen(walker, 0.0))
    walker.command(VelocityCommand(0.3))
    walker.update(seen(walker, 0.01, pitch_rad=1.5))
    for tick in range(200):
        walker.update(seen(walker, 0.02 + 0.01 * tick))
    assert not walker.has_fallen
    assert walker.status is not None
    assert walker.status.phase == 'stand'


def test_reset_ends_a_fall(walker: Walker) -> None:
    """Whoever resets has put the robot somewhere."""
    walker.update(seen(walker, 0.0))
    walker.update(seen(walker, 0.01, pitch_rad=1.5))
    walker.reset()
    assert not walker.has_fallen
    walker.update(seen(walker, 0.02))
    assert not walker.has_fallen


def test_the_way_to_standing_is_smooth() -> None:
    """It begins and ends at rest, and its velocity is the derivative of its position."""
    start, home = np.array([0.0, 1.0]), np.array([1.0, -1.0])
    rising = Rising(start, home, WalkParameters(), 5.0)
    end_s = 5.0 + WalkParameters().fall.stand_up_s
    assert rising.targets(5.0).positions_rad == pytest.approx(start)
    assert rising.targets(end_s).positions_rad == pytest.approx(home)
    assert rising.targets(end_s + 9.0).velocities_rad_s == pytest.approx(0.0)
    assert rising.is_done(end_s)
    assert not rising.is_done(end_s - 0.01)
    step_s = 1e-5
    slope = rising.targets(5.5 + step_s).positions_rad - rising.targets(5.5).positions_rad
    assert rising.targets(5.5).velocities_rad_s == pytest.approx(slope / step_s, rel=1e-3)
