# SPDX-License-Identifier: Apache-2.0
"""Check that the way round the square is found, whatever the robot makes of its commands."""

from __future__ import annotations

import math

from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand
from humanoid_simulation.examples.square_drive import Corner, SquareDrive, SquarePlan
import numpy as np
import pytest

PERIOD_S = 0.02
START = PlanarPose(2 - 1j, 0.7)


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
