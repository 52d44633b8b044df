# SPDX-License-Identifier: Apache-2.0
"""Check the walk where control is bad: late, noisy, or absent for a while."""

from __future__ import annotations

from humanoid_control.walking import PlanarPose
from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.examples.square_walk import Corner, SquareDrive, SquarePlan
from humanoid_simulation.scene import Scene, Thing
from humanoid_simulation.testing.lockstep_robot import DropOuts, LockstepRobot
import numpy as np
import pytest

EXTRAPOLATION_S = 0.03


def walked(robot: LockstepRobot) -> PlanarPose:
    """Stand, walk, turn, step to the side and stop; return where that led."""
    assert robot.wait(1.0)
    for velocity in ((0.25, 0.0, 0.0), (0.1, 0.0, 0.4), (0.0, 0.1, 0.0)):
        robot.drive(*velocity)
        assert robot.wait(3.0), velocity
    robot.drive()
    assert robot.wait(3.0)
    return robot.pose


@pytest.mark.parametrize('periods', [pytest.param(1, marks=pytest.mark.story), 2])
def test_old_observations(periods: int) -> None:
    """With 10 and 20 ms of latency it goes more slowly, but where it is to."""
    end = walked(LockstepRobot(BackendSettings(latency_periods=periods)))
    assert 0.25 < end.position_m.real < 1.0
    assert 0.1 < end.position_m.imag < 0.5


def test_drop_outs() -> None:
    """Control that is away for up to 50 ms now and then is enough."""
    random = np.random.default_rng(1)
    settings = BackendSettings(extrapolation_s=EXTRAPOLATION_S)
    robot = LockstepRobot(settings, misses=DropOuts(random, 0.02, 5).misses)
    end = walked(robot)
    assert end.position_m.real > 0.5


def test_the_same_seed_is_the_same_walk() -> None:
    """With noise and drop-outs, bit for bit; another seed is another walk."""

    def end(seed: int) -> tuple[complex, float]:
        random = np.random.default_rng(seed)
        settings = BackendSettings(noise=REALISTIC, seed=seed, extrapolation_s=EXTRAPOLATION_S)
        robot = LockstepRobot(settings, misses=DropOuts(random, 0.01, 3).misses)
        robot.drive(0.25)
        assert robot.wait(4.0)
        return robot.pose.position_m, robot.pose.yaw_rad

    first = end(1)
    assert end(1) == first
    assert end(2) != first


WALL = Thing('wall', 'box', (0.1, 3.0, 1.2), (0.75, 0.0, 0.6))
EDGE = Thing('table', 'box', (0.6, 1.6, 0.04), (1.0, 0.0, 0.38), (0.0, 0.0, 0.2))
BEHIND = Thing('wall', 'box', (0.1, 3.0, 1.2), (-0.6, 0.0, 0.6))
BESIDE = Thing('shelf', 'box', (3.0, 0.1, 1.0), (0.0, 0.6, 0.5))
BOARD = Thing('board', 'box', (1.6, 0.6, 0.04), (0.0, -0.86, 0.38), (0.0, 0.0, 0.1))
CORNER = Thing('cupboard', 'box', (0.8, 0.3, 1.0), (0.5, 0.56, 0.5), (0.0, 0.0, 0.99))


@pytest.mark.parametrize(
    ('obstacle', 'velocity'),
    [
        (WALL, (0.5, 0.0)),
        pytest.param(EDGE, (0.3, 0.0), marks=pytest.mark.story),
        pytest.param(BEHIND, (-0.2, 0.0), marks=pytest.mark.story),
        pytest.param(BESIDE, (0.0, 0.15), marks=pytest.mark.story),
        (BOARD, (0.0, -0.13)),
        pytest.param(CORNER, (0.4, 0.0), marks=pytest.mark.story),
    ],
    ids=['wall', 'edge of a table', 'behind', 'beside', 'board at its thighs', 'corner'],
)
def test_it_stops_at_what_is_in_its_way(obstacle: Thing, velocity: tuple[float, float]) -> None:
    """It notices, steps back, stands for as long as somebody insists, and can then walk away."""
    settings = BackendSettings(noise=REALISTIC, seed=1)
    robot = LockstepRobot(settings, Scene(things=(obstacle,)))
    walker = robot.walking.walker
    assert robot.wait(1.0)
    robot.drive(*velocity)
    assert robot.wait(6.0)
    assert walker.is_blocked
    place_m = robot.pose.position_m
    assert robot.wait(2.0)
    assert abs(robot.pose.position_m - place_m) < 0.2
    robot.drive(-velocity[0], -velocity[1])
    assert robot.wait(2.0)
    assert not walker.is_blocked
    robot.drive()
    assert robot.wait(2.0)


def test_it_pushes_away_what_is_loose() -> None:
    """A box that a foot kicks is no ground to stand on; the robot stays on its feet."""
    box = Thing('box', 'box', (0.2, 0.2, 0.3), (0.0, 0.5, 0.15), mass_kg=1.0)
    settings = BackendSettings(noise=REALISTIC, seed=1)
    robot = LockstepRobot(settings, Scene(things=(box,)))
    robot.drive(0.0, 0.15)
    assert robot.wait(7.0)
    robot.drive()
    assert robot.wait(2.0)


def test_a_reset_while_walking_forgets_the_walk() -> None:
    """After it the robot walks as it does from the start."""
    robot = LockstepRobot()
    robot.drive(0.25)
    assert robot.wait(3.3)
    robot.reset()
    assert abs(robot.pose.position_m) < 1e-9
    assert robot.wait(1.0)
    robot.drive(0.25)
    assert robot.wait(3.0)
    assert robot.pose.position_m.real > 0.3


@pytest.mark.story
def test_a_square_by_odometry() -> None:
    """The drive of the example leads a robot that really steps round its square, and stops it."""
    robot = LockstepRobot()
    assert robot.wait(1.0)
    drive, corners = SquareDrive(odometry(robot), SquarePlan(side_m=0.6)), list[Corner]()
    while not drive.is_done and robot.backend.time_s < 60.0:
        command, corner = drive.update(odometry(robot))
        corners += [corner] if corner else []
        robot.drive(command.forward_m_s, command.left_m_s, command.turn_rad_s)
        assert robot.wait(0.02)
    assert robot.wait(3.0)
    assert [corner.number for corner in corners] == [1, 2, 3, 4]
    assert abs(robot.pose.position_m) < 0.15


def odometry(robot: LockstepRobot) -> PlanarPose:
    """Return where the robot believes to be."""
    status = robot.walking.walker.status
    assert status is not None
    return status.odometry.pose
