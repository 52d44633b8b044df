# SPDX-License-Identifier: Apache-2.0
"""Check the walk where control is bad: late, noisy, or absent for a while."""

from __future__ import annotations

from humanoid_control.walking import PlanarPose
from humanoid_simulation.backend import BackendSettings
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.disturbances import DropOuts
from humanoid_simulation.examples.square_drive import Corner, SquareDrive, SquarePlan
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
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


@pytest.mark.parametrize('periods', [1, 2])
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

    assert end(1) == end(1)
    assert end(1) != end(2)


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
