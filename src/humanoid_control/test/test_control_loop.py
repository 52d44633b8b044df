# SPDX-License-Identifier: Apache-2.0
"""Check robots and what controls them, in lockstep."""

from __future__ import annotations

from humanoid_control.controllers import CommandError, follow_mode, hold_mode, TrajectoryPoint
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.mock_backend import MockBackend
from humanoid_control.testing import DRIVES, JOINTS, LIMITS
from humanoid_control.walking.commands import STANDING, VelocityCommand
import pytest


class Fleet:
    """Two robots that follow commands, and the velocities that the first one was driven at."""

    def __init__(self) -> None:
        """Begin."""
        self.driven: list[VelocityCommand] = []
        self.robots = {
            name: RobotControl(JOINTS, LIMITS, (follow_mode(JOINTS), hold_mode(JOINTS)), drive)
            for name, drive in (('robot1', self.driven.append), ('robot2', None))
        }
        backend = MockBackend(DRIVES, tuple(self.robots), home_rad={'left_knee': 0.2})
        self.loop = ControlLoop(backend, self.robots)

    def run(self, ticks: int) -> dict[str, list[float]]:
        """Let time pass; return the positions of each robot."""
        for _ in range(ticks):
            observations = self.loop.tick()
        return {name: seen.positions_rad.tolist() for name, seen in observations.items()}


def test_commands_reach_one_robot() -> None:
    """A command moves the joints of its robot; without more it stays there."""
    fleet = Fleet()
    fleet.run(1)
    fleet.robots['robot1'].follow(['left_elbow'], [0.5])
    positions = fleet.run(200)
    assert positions['robot1'] == pytest.approx([0.5, 0.0, 0.2], abs=1e-3)
    assert positions['robot2'] == pytest.approx([0.0, 0.0, 0.2])


def test_trajectory() -> None:
    """A trajectory is run; meanwhile nobody else may command its joints."""
    fleet = Fleet()
    fleet.run(1)
    robot = fleet.robots['robot2']
    robot.run(['right_elbow'], [TrajectoryPoint(1.0, [-0.6])])
    fleet.run(2)
    with pytest.raises(CommandError, match="'right_elbow' is claimed by 'joint_trajectory'"):
        robot.follow(['right_elbow'], [0.1])
    robot.follow(['left_elbow'], [0.1])
    assert fleet.run(200)['robot2'] == pytest.approx([0.1, -0.6, 0.2], abs=1e-3)
    robot.follow(['right_elbow'], [0.1])


def test_velocity_and_its_timeout() -> None:
    """The robot is driven as commanded for half a second, and then stands."""
    fleet = Fleet()
    fleet.robots['robot1'].walk(VelocityCommand(0.2, 0.0, 0.1))
    fleet.run(60)
    assert fleet.driven[49] == VelocityCommand(0.2, 0.0, 0.1)
    assert fleet.driven[51] == STANDING


def test_robot_without_legs_to_walk() -> None:
    """A velocity for a robot that does not walk is refused."""
    with pytest.raises(CommandError, match='cannot walk'):
        Fleet().robots['robot2'].walk(VelocityCommand(0.2))


def test_stop() -> None:
    """While it must hold still, the robot stands, its joints stay, and commands are not heard."""
    fleet = Fleet()
    robot = fleet.robots['robot1']
    fleet.run(1)
    robot.walk(VelocityCommand(0.2))
    robot.run(['right_elbow'], [TrajectoryPoint(1.0, [-0.6])])
    robot.follow(['left_elbow'], [0.5])
    fleet.run(30)
    robot.hold_still(True)
    halfway = fleet.run(60)['robot1']
    assert -0.5 < halfway[1] < -0.05 and fleet.driven[-1] == STANDING
    robot.follow(['left_elbow'], [0.9])
    robot.walk(VelocityCommand(0.2))
    assert fleet.run(100)['robot1'] == pytest.approx(halfway, abs=1e-3)
    assert fleet.driven[-1] == STANDING


def test_release() -> None:
    """A robot that was released stays where it is until it is commanded again."""
    fleet = Fleet()
    robot = fleet.robots['robot1']
    robot.hold_still(True)
    fleet.run(5)
    robot.hold_still(False)
    fleet.run(5)
    robot.follow(['left_elbow'], [0.5])
    assert fleet.run(100)['robot1'] == pytest.approx([0.5, 0.0, 0.2], abs=1e-3)


def test_reset() -> None:
    """A reset puts all robots home, without a memory of commands."""
    fleet = Fleet()
    fleet.run(1)
    fleet.robots['robot1'].follow(['left_elbow'], [0.5])
    fleet.run(30)
    fleet.loop.reset()
    assert fleet.run(100)['robot1'] == pytest.approx([0.0, 0.0, 0.2])


def test_brain_without_a_robot() -> None:
    """A brain for a robot that there is not is refused."""
    fleet = Fleet()
    with pytest.raises(ValueError, match=r"brains for \['robot2'\], but the robots are"):
        ControlLoop(MockBackend(DRIVES, ('robot1',)), fleet.robots)
