# SPDX-License-Identifier: Apache-2.0
"""Check that the way round the square is found, and what is said about it."""

from __future__ import annotations

import math

from humanoid_control.walking.commands import STANDING, VelocityCommand
from humanoid_control.walking.planar import PlanarPose
from humanoid_simulation.examples.square_walk import (
    Corner,
    NotRoundError,
    SquareDrive,
    SquarePlan,
    SquareWalk,
)
import numpy as np
import pytest

PERIOD_S = 0.02
SLIP = 1.05
START = PlanarPose(2 - 1j, 0.7)


class Run:
    """Walks with a robot whose odometry believes in steps that are shorter than the real ones."""

    def __init__(self) -> None:
        self.news: list[str] = []
        pose = PlanarPose()
        walk = SquareWalk(SquarePlan(), 0.0, pose, pose)
        truth, time_s = pose, 0.0
        while True:
            progress = walk.update(time_s, pose, truth, stands=True)
            self.news += [progress.news] if progress.news else []
            if progress.is_done:
                self.last = progress
                return
            velocity, time_s = progress.command, time_s + PERIOD_S
            forward_m, left_m = velocity.forward_m_s * PERIOD_S, velocity.left_m_s * PERIOD_S
            yaw_rad = pose.yaw_rad + velocity.turn_rad_s * PERIOD_S
            truth = PlanarPose(truth.at(SLIP * forward_m, SLIP * left_m), yaw_rad)
            pose = PlanarPose(pose.at(forward_m, left_m), yaw_rad)


def test_each_corner_and_the_end_are_told() -> None:
    """Four corners, and then how far the end is from the beginning."""
    run = Run()
    assert [text.partition(':')[0] for text in run.news] == [
        *(f'Corner {number} of 4' for number in (1, 2, 3, 4)),
        'Square completed. Closing error',
    ]
    assert run.news[0].startswith('Corner 1 of 4: (0.97, 0.00) m, 3 cm off')
    assert 'on ground truth' in run.news[-1] and 'by odometry' in run.news[-1]
    assert run.last.command == STANDING


def test_a_fall_ends_the_walk() -> None:
    """A robot that lies is not driven on."""
    walk = SquareWalk(SquarePlan(), 0.0, PlanarPose(), PlanarPose())
    with pytest.raises(NotRoundError, match='fell'):
        walk.update(0.1, PlanarPose(), PlanarPose(), stands=False)


def test_a_robot_that_does_not_get_on_is_given_up() -> None:
    """Four times the planned time is enough."""
    walk = SquareWalk(SquarePlan(), 0.0, PlanarPose(), PlanarPose())
    walk.update(100.0, PlanarPose(), PlanarPose(), stands=True)
    with pytest.raises(
        NotRoundError, match='has not completed the square in 4 times the planned time'
    ):
        walk.update(200.0, PlanarPose(), PlanarPose(), stands=True)


def moved(pose: PlanarPose, velocity: VelocityCommand) -> PlanarPose:
    """Return the pose after a period."""
    step = pose.at(velocity.forward_m_s * PERIOD_S, velocity.left_m_s * PERIOD_S)
    return PlanarPose(step, pose.yaw_rad + velocity.turn_rad_s * PERIOD_S)


def walk(
    drive: SquareDrive, pose: PlanarPose, gain: float = 1.0, veer: VelocityCommand = STANDING
) -> tuple[PlanarPose, list[Corner]]:
    """Walk with a robot that goes too fast by a factor, and veers; return where it ends."""
    corners = []
    for _ in range(5000):
        command, corner = drive.update(pose)
        corners += [corner] if corner else []
        if drive.is_done:
            return pose, corners
        pose = moved(moved(pose, command.times(gain)), veer)
    raise AssertionError('it does not arrive')


@pytest.mark.parametrize('gain', [0.8, 1.0, 1.2])
def test_it_comes_round(gain: float) -> None:
    """All corners are met in order, and the robot ends where and as it began."""
    end, corners = walk(SquareDrive(START, SquarePlan()), START, gain)
    assert [corner.number for corner in corners] == [1, 2, 3, 4]
    assert max(corner.error_m for corner in corners) < 0.05
    assert abs(end.position_m - START.position_m) < 0.05
    assert math.remainder(end.yaw_rad - START.yaw_rad, 2 * math.pi) == pytest.approx(0, abs=0.06)


def test_the_square_lies_to_the_left() -> None:
    """The corners are those of a square that is walked anticlockwise."""
    _, corners = walk(SquareDrive(PlanarPose(), SquarePlan(side_m=2.0)), PlanarPose())
    planned = [corner.planned.position_m for corner in corners]
    assert planned == pytest.approx([2, 2 + 2j, 2j, 0])


def test_a_veering_robot_is_kept_on_the_line() -> None:
    """A drift to the side and a slow turn are corrected."""
    veer = VelocityCommand(0.0, 0.02, -0.03)
    end, corners = walk(SquareDrive(START, SquarePlan()), START, veer=veer)
    assert max(corner.error_m for corner in corners) < 0.08
    assert abs(end.position_m - START.position_m) < 0.08


def test_no_command_is_faster_than_planned() -> None:
    """However far away the robot is, it is told to go at the speeds of the plan at most."""
    plan = SquarePlan()
    generator = np.random.default_rng(1)
    for x, y, yaw in generator.uniform(-9, 9, (200, 3)):
        command, _ = SquareDrive(START, plan).update(PlanarPose(complex(x, y), yaw))
        assert abs(command.forward_m_s) <= plan.speed_m_s
        assert abs(command.left_m_s) <= plan.sideways_m_s
        assert abs(command.turn_rad_s) <= plan.turn_rad_s


def test_at_the_end_it_stands() -> None:
    """Once round, the drive commands standing, wherever the robot is pushed to."""
    drive = SquareDrive(START, SquarePlan())
    walk(drive, START)
    assert drive.update(PlanarPose(9 + 9j, 1.0)) == (STANDING, None)
