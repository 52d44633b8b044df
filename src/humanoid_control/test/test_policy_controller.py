# SPDX-License-Identifier: Apache-2.0
"""Check the mode `policy`: when it decides, what it holds, falls, and faults."""

from __future__ import annotations

from collections.abc import Callable
import math
from pathlib import Path
from typing import Any

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers import CommandError, follow_mode
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.policy import PolicyController
from humanoid_control.policy.testing import FakeNetwork, policy_of, ROBOT
from humanoid_control.testing import JOINTS, LIMITS, observed, PERIOD_S, targets
from humanoid_control.walking.commands import VelocityCommand
import numpy as np
import pytest

COMMAND = {'terms': [{'name': 'velocity_commands'}]}


class FakeFallWatch:
    """Says what it is told to."""

    def __init__(self) -> None:
        self.down: JointTargets | None = None

    @property
    def has_fallen(self) -> bool:
        """Whether the robot is down."""
        return self.down is not None

    def watch(self, observation: Observation) -> JointTargets | None:
        """Return the targets of a robot that is down."""
        return self.down


class Robot:
    """A robot with three joints that follows its targets, in the mode `policy`."""

    def __init__(self, folder: Path, answer: Callable[[np.ndarray], Any], **changes: Any) -> None:
        self.said: list[str] = []
        self.fall_watch = FakeFallWatch()
        self.controller = PolicyController(ROBOT, self.fall_watch, self.said.append)
        modes = [follow_mode(JOINTS), self.controller.mode()]
        self.control = RobotControl(JOINTS, LIMITS, modes, self.controller.walk)
        self.now_s, self.positions_rad = 0.0, np.zeros(3)
        self.network = self.load(folder, answer, **changes)
        self.control.manager.switch('policy')

    def load(
        self, folder: Path, answer: Callable[[np.ndarray], Any], **changes: Any
    ) -> FakeNetwork:
        """Load a policy, and return its network."""
        self.controller.policy, network = policy_of(folder, answer, **changes)
        self.control.manager.replace(self.controller.mode())
        return network

    def run(self, periods: int) -> list[float]:
        """Let time pass; return where the joints are."""
        for _ in range(periods):
            observation = observed(self.now_s, *self.positions_rad.tolist())
            self.positions_rad = self.control.update(observation).positions_rad
            self.now_s += PERIOD_S
        return [round(float(each), 3) for each in self.positions_rad]


def test_it_moves_its_joints_and_holds_the_others(tmp_path: Path) -> None:
    """From the default pose by the action; without a jump."""
    robot = Robot(tmp_path, lambda o: [0.2, -0.4])
    robot.positions_rad[1] = 0.6
    first = robot.run(1)
    assert first == pytest.approx([0.0, 0.6, 0.0], abs=0.01)
    assert robot.run(60) == pytest.approx([-0.1 - 0.2, 0.6, 0.2 + 0.1])
    assert robot.said == []


def test_it_decides_at_its_own_rate(tmp_path: Path) -> None:
    """Not in each control period; also at a rate that is no divisor of that of the loop."""
    for rate_hz, decisions in ((50.0, 50), (100.0, 100), (30.0, 30)):
        robot = Robot(tmp_path, lambda o: [0.0, 0.0], rate_hz=rate_hz)
        robot.run(100)
        assert len(robot.network.observed) == pytest.approx(decisions, abs=1)


def test_the_command(tmp_path: Path) -> None:
    """It observes the velocity; a stop makes it zero."""
    robot = Robot(tmp_path, lambda o: [0.0, 0.0], observation=COMMAND)
    robot.control.walk(VelocityCommand(0.3, -0.1, 0.5))
    robot.run(10)
    assert robot.network.observed[-1] == pytest.approx([0.3, -0.1, 0.5])
    robot.control.hold_still(True)
    robot.run(10)
    assert robot.network.observed[-1].tolist() == [0.0, 0.0, 0.0]


def test_what_others_may_move(tmp_path: Path) -> None:
    """The joints that the policy does not move, also when it is replaced by another one."""
    robot = Robot(tmp_path, lambda o: [0.0, 0.0])
    robot.run(60)
    with pytest.raises(CommandError, match="'left_knee' is claimed by the mode 'policy'"):
        robot.control.follow(['left_knee'], [0.3])
    for _ in range(40):
        robot.control.follow(['right_elbow'], [0.4])
        robot.run(2)
    assert robot.positions_rad[1] == pytest.approx(0.4)
    robot.load(tmp_path, lambda o: [0.0], joints=['left_elbow'], default_rad=0.0)
    robot.run(2)
    robot.control.follow(['left_knee'], [0.3])


@pytest.mark.parametrize('bad', [math.nan, math.inf])
def test_a_fault(tmp_path: Path, bad: float) -> None:
    """The robot holds its pose and says so once, until the mode is set again."""
    answer = [0.2, -0.4]
    robot = Robot(tmp_path, lambda o: answer)
    before = robot.run(80)
    answer[0] = bad
    assert robot.run(40) == pytest.approx(before)
    (sentence,) = robot.said
    assert "for 'left_knee'" in sentence and 'The robot holds its pose.' in sentence
    assert 'the policy has failed' in robot.control.manager.claims.trouble
    answer[0] = 0.0
    assert robot.run(40) == pytest.approx(before)
    robot.control.manager.switch('follow')
    robot.run(2)
    robot.control.manager.switch('policy')
    assert robot.run(80)[2] == pytest.approx(0.2)
    assert robot.control.manager.claims.trouble == ''


def test_a_fall(tmp_path: Path) -> None:
    """The fall watch moves the joints; afterwards the policy begins anew."""
    robot = Robot(tmp_path, lambda o: [0.0, 0.0])
    robot.run(80)
    robot.fall_watch.down = targets(0.5, 0.5, 0.5)
    decisions = len(robot.network.observed)
    assert robot.run(30) == pytest.approx([0.5, 0.5, 0.5])
    assert len(robot.network.observed) == decisions
    assert 'has fallen' in robot.control.manager.claims.trouble
    robot.fall_watch.down = None
    assert robot.run(30) == pytest.approx([-0.1, 0.5, 0.2])


def test_without_a_policy(tmp_path: Path) -> None:
    """All joints are held, and nobody may claim one."""
    robot = Robot(tmp_path, lambda o: [0.0, 0.0])
    robot.controller.policy = None
    robot.control.manager.replace(robot.controller.mode())
    robot.positions_rad[:] = 0.1, 0.2, 0.3
    assert robot.run(60) == pytest.approx([0.1, 0.2, 0.3])
    assert "set the parameter 'policy'" in robot.control.manager.claims.trouble
    with pytest.raises(CommandError):
        robot.control.follow(['right_elbow'], [0.4])


def test_a_reset(tmp_path: Path) -> None:
    """The time may go back, and the policy decides at once."""
    robot = Robot(tmp_path, lambda o: [0.0, 0.0])
    robot.run(50)
    robot.now_s = 0.0
    robot.control.reset()
    decisions = len(robot.network.observed)
    robot.run(1)
    assert len(robot.network.observed) == decisions + 1
