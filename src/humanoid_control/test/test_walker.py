# SPDX-License-Identifier: Apache-2.0
"""Check the walker: what it makes of observations, good and bad."""

from __future__ import annotations

from dataclasses import replace
import math

from humanoid_control.backends import Observation
from humanoid_control.walking import VelocityCommand, Walker, WalkingError, WalkParameters
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
import numpy as np
import pytest

WEIGHT_N = 42.8 * 9.81


@pytest.fixture(name='walker')
def _walker(robot: Robot) -> Walker:
    """Return a walker that has not begun."""
    drives = load_drives()
    return Walker.of(robot, drives, tuple(drives), WalkParameters())


def standing(walker: Walker, time_s: float, yaw_rad: float = 0.0) -> Observation:
    """Return what a robot observes that stands at home."""
    n = len(walker.home.positions_rad)
    orientation = np.array([math.cos(yaw_rad / 2), 0.0, 0.0, math.sin(yaw_rad / 2)])
    forces = np.array([[0.0, 0.0, WEIGHT_N / 2]] * 2)
    up = np.array([0.0, 0.0, 9.81])
    still = np.zeros(n)
    return Observation(
        time_s,
        walker.home.positions_rad.copy(),
        still,
        still,
        orientation,
        np.zeros(3),
        up,
        forces,
        np.zeros((2, 3)),
    )


@pytest.mark.parametrize('yaw_rad', [0.0, 2.0])
def test_standing_at_home_stays(walker: Walker, yaw_rad: float) -> None:
    """A robot that stands at home is told to stay there, whichever way it faces."""
    for tick in range(50):
        targets = walker.update(standing(walker, 5.0 + 0.01 * tick, yaw_rad))
    assert targets.positions_rad == pytest.approx(walker.home.positions_rad, abs=1e-6)
    assert targets.velocities_rad_s == pytest.approx(0, abs=1e-3)
    assert np.abs(targets.efforts_nm).max() < 60.0


def test_odometry_begins_at_zero(walker: Walker) -> None:
    """Odometry begins where the robot stands and where it faces."""
    assert walker.status is None
    walker.update(standing(walker, 5.0, 2.0))
    status = walker.status
    assert status is not None
    odometry = status.odometry
    assert odometry.pose.position_m == pytest.approx(0, abs=1e-12)
    assert odometry.pose.yaw_rad == pytest.approx(0, abs=1e-12)
    assert odometry.height_m == pytest.approx(walker.home.base_height_m, abs=1e-9)
    assert odometry.orientation == pytest.approx((1, 0, 0, 0), abs=1e-9)
    assert status.phase == 'stand'
    assert status.support == (0, 1)


def test_a_velocity_makes_it_step(walker: Walker) -> None:
    """With a velocity the weight goes to one side, and footsteps are planned."""
    walker.update(standing(walker, 0.0))
    walker.command(VelocityCommand(0.2))
    walker.update(standing(walker, 0.01))
    status = walker.status
    assert status is not None
    assert status.phase == 'walk'
    assert len(status.footsteps) == WalkParameters().footsteps.preview_steps
    assert status.zmp_m.imag != 0.0


def test_the_same_moment_gives_the_same_targets(walker: Walker) -> None:
    """A second tick at the same time, or an earlier one, changes nothing."""
    first = walker.update(standing(walker, 1.0))
    assert walker.update(standing(walker, 1.0)) is first
    assert walker.update(standing(walker, 0.5)) is first


@pytest.mark.parametrize(
    'field',
    [
        'positions_rad',
        'velocities_rad_s',
        'angular_velocity_rad_s',
        'orientation',
        'foot_forces_n',
        'linear_acceleration_m_s2',
        'efforts_nm',
    ],
)
@pytest.mark.parametrize('bad', [math.nan, math.inf])
def test_bad_observations_are_refused(walker: Walker, field: str, bad: float) -> None:
    """What is not finite is refused, and a good observation afterwards is taken as before."""
    walker.update(standing(walker, 0.0))
    observation = standing(walker, 0.01)
    values = getattr(observation, field).copy()
    values[-1] = bad
    with pytest.raises(WalkingError, match='finite'):
        walker.update(replace(observation, **{field: values}))
    targets = walker.update(standing(walker, 0.02))
    assert targets.positions_rad == pytest.approx(walker.home.positions_rad, abs=1e-6)


def test_a_wrong_length_is_refused(walker: Walker) -> None:
    """Positions of too few joints are refused."""
    observation = standing(walker, 0.0)
    short = replace(observation, positions_rad=observation.positions_rad[:-1])
    with pytest.raises(WalkingError, match='shape'):
        walker.update(short)


def test_reset_forgets_and_restart_goes_on(walker: Walker) -> None:
    """After a reset odometry begins anew; after a restart it goes on from where it was."""
    walker.update(standing(walker, 0.0, 0.5))
    walker.update(standing(walker, 0.1, 0.8))
    walker.restart()
    walker.update(standing(walker, 0.2, 0.8))
    assert walker.status is not None
    assert walker.status.odometry.pose.yaw_rad == pytest.approx(0.3)
    walker.reset()
    assert walker.status is None
    walker.update(standing(walker, 0.3, 0.8))
    assert walker.status.odometry.pose.yaw_rad == pytest.approx(0.0)
