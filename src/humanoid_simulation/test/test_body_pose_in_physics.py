# SPDX-License-Identifier: Apache-2.0
"""Bend the simulated robot while it stands, and let it walk and be pushed out of that."""

from __future__ import annotations

from collections.abc import Iterator
import math

from humanoid_control.controllers import (
    ErrorCode,
    GoalResult,
    TrajectoryPoint,
    TrajectoryRequest,
)
from humanoid_control.walking.commands import BodyPose
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import pytest


class Bent:
    """A robot that stands."""

    def __init__(self) -> None:
        """Let it stand."""
        self.robot = LockstepRobot(BackendSettings(noise=REALISTIC, seed=1))
        self.walker = self.robot.walking.walker
        assert self.robot.wait(1.0)
        self.height_m = self.shoulder_m[2]
        self.ahead_m = self.shoulder_m[0]

    @property
    def pitch_rad(self) -> float:
        """Return how far the pelvis truly is bent forward."""
        rotation = self.robot.backend.data.body('robot/base_link').xmat.reshape(3, 3)
        return math.asin(-float(rotation[2, 0]))

    @property
    def shoulder_m(self) -> tuple[float, float, float]:
        """Return where the shoulder truly is, from the foot and the ground."""
        data = self.robot.backend.data
        shoulder = data.body('robot/left_shoulder_link').xpos
        foot = data.body('robot/left_foot').xpos
        return float(shoulder[0] - foot[0]), float(shoulder[1] - foot[1]), float(shoulder[2])

    def hold(self, pitch_rad: float, height_m: float, seconds: float = 3.0) -> None:
        """Bend, and stay on the feet without a step."""
        self.walker.hold(BodyPose(pitch_rad, height_m))
        for _ in range(round(seconds * 10.0)):
            assert self.robot.wait(0.1)
            assert self.walker.phase == 'stand'


@pytest.fixture(name='bent')
def _bent() -> Iterator[Bent]:
    """Give a robot."""
    robot = Bent()
    yield robot
    robot.robot.backend.close()


def test_it_bends_and_lowers_itself(bent: Bent) -> None:
    """The shoulders come forward and down; the feet stay."""
    bent.hold(0.5, -0.08)
    assert bent.pitch_rad == pytest.approx(0.5, abs=0.05)
    assert bent.shoulder_m[0] > bent.ahead_m + 0.08
    assert bent.shoulder_m[2] < bent.height_m - 0.08
    bent.hold(0.0, 0.0)
    assert bent.pitch_rad == pytest.approx(0.0, abs=0.03)
    assert bent.shoulder_m[2] == pytest.approx(bent.height_m, abs=0.02)


def test_who_is_to_walk_comes_up_first(bent: Bent) -> None:
    """Then the pose is forgotten."""
    bent.hold(0.4, -0.05)
    bent.robot.drive(0.2)
    while bent.walker.phase == 'stand':
        assert bent.robot.wait(0.05)
    assert abs(bent.pitch_rad) < 0.1
    assert bent.robot.wait(2.0)
    assert bent.robot.pose.position_m.real > 0.15
    bent.robot.drive()
    assert bent.robot.wait(3.0)
    assert bent.walker.phase == 'stand' and abs(bent.pitch_rad) < 0.03


@pytest.mark.parametrize('angle_rad', [1.2, -1.2])
def test_it_stands_and_walks_with_its_waist_turned(bent: Bent, angle_rad: float) -> None:
    """Somebody reaches with an arm meanwhile, say."""
    control = bent.robot.walking.control
    waist = control.goals.limbs['waist_controller']
    ends: list[GoalResult] = []
    request = TrajectoryRequest(waist.own, [TrajectoryPoint(1.0, [angle_rad])])
    waist.accept(control.goals.checked_goal('waist_controller', request), ends.append)
    assert bent.robot.wait(2.0)
    assert [end.code for end in ends] == [ErrorCode.SUCCESSFUL]
    bent.robot.drive(0.25, 0.0, 0.2)
    assert bent.robot.wait(4.0)
    assert abs(bent.robot.pose.position_m) > 0.5
    bent.robot.drive()
    assert bent.robot.wait(2.0)
    bent.hold(0.4, -0.05)


@pytest.mark.parametrize('direction', [1.0, -1.0, 1j])
def test_it_bears_a_push(bent: Bent, direction: complex) -> None:
    """Of 6 N s, with a step if it needs one."""
    bent.hold(0.4, -0.05)
    bent.robot.push(direction, 6.0)
    assert bent.robot.wait(3.0)


def test_a_stop_freezes_it(bent: Bent) -> None:
    """Half way down it bends no further."""
    bent.walker.hold(BodyPose(0.5, 0.0))
    assert bent.robot.wait(0.6)
    bent.robot.walking.control.hold_still(True)
    there_rad = bent.walker.pose.pitch_rad
    assert 0.1 < there_rad < 0.4
    assert bent.robot.wait(1.0)
    assert bent.pitch_rad == pytest.approx(there_rad, abs=0.05)
