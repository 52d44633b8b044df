# SPDX-License-Identifier: Apache-2.0
"""Check what is said about a walk round a square."""

from __future__ import annotations

from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.velocity_command import STANDING
from humanoid_simulation.examples.square_drive import SquarePlan
from humanoid_simulation.examples.square_walk import NotRoundError, SquareWalk
import pytest

PERIOD_S = 0.02
SLIP = 1.05


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
        'Round. Closing error',
    ]
    assert run.news[0].startswith('Corner 1 of 4: (0.97, 0.00) m, 3 cm from where it is')
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
    with pytest.raises(NotRoundError, match='has not come round in 4 times the planned time'):
        walk.update(200.0, PlanarPose(), PlanarPose(), stands=True)
