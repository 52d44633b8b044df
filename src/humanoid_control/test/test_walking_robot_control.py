# SPDX-License-Identifier: Apache-2.0
"""Check the control of a robot that walks, on a mock of it, and the velocity passed on."""

from __future__ import annotations

from types import SimpleNamespace

from humanoid_control.controllers import CommandError
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.parameters import MODES
from humanoid_control.hosting.walking_robot import WalkingController, WalkingRobotControl
from humanoid_control.mock_backend import MockBackend
from humanoid_control.walking.commands import STANDING, VelocityCommand
from humanoid_description.drives import load_drives
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_description.robot import Robot
import numpy as np
import pytest

AHEAD = VelocityCommand(0.2)


@pytest.fixture(name='model', scope='module')
def _model() -> Robot:
    """Return the model of the humanoid."""
    return load_robot(humanoid_urdf(), 'the humanoid')


class Humanoid:
    """A humanoid that walks in the air."""

    def __init__(self, model: Robot) -> None:
        """Begin to stand."""
        drives = load_drives()
        self.robot = WalkingRobotControl.of(model, drives)
        self.control, self.walker = self.robot.control, self.robot.walker
        backend = MockBackend(drives, mass_kg=model.mass_kg, home_rad=self.robot.home_rad)
        self.loop = ControlLoop(backend, {'': self.control})
        self.positions_rad: list[np.ndarray] = []

    def run(self, ticks: int, forward_m_s: float = 0.0) -> None:
        """Let time pass, while somebody drives."""
        for _ in range(ticks):
            if forward_m_s:
                self.control.walk(VelocityCommand(forward_m_s))
            self.positions_rad.append(self.loop.tick()[''].positions_rad)

    @property
    def phase(self) -> str:
        """Return how it walks."""
        status = self.walker.status
        assert status is not None
        return status.phase

    def joint_rad(self, joint: str) -> float:
        """Return where a joint is."""
        return float(self.positions_rad[-1][self.control.manager.joints.index(joint)])


@pytest.fixture(name='humanoid')
def _humanoid(model: Robot) -> Humanoid:
    """Return a humanoid that stands."""
    humanoid = Humanoid(model)
    humanoid.run(20)
    return humanoid


def test_each_mode_can_be_chosen(humanoid: Humanoid) -> None:
    """By the parameter `mode`, in whose first choice the robot starts."""
    assert humanoid.control.manager.modes == MODES
    assert humanoid.control.manager.mode == MODES[0]


def test_what_can_be_claimed(humanoid: Humanoid) -> None:
    """Walking leaves all above the legs to controllers, and keeps these."""
    joints = humanoid.control.manager.joints
    for joint in joints:
        is_upper = any(part in joint for part in ('elbow', 'shoulder', 'head', 'waist'))
        if is_upper:
            humanoid.control.follow([joint], [0.1])
        else:
            with pytest.raises(CommandError, match=f"'{joint}' is claimed by the mode 'walking'"):
                humanoid.control.follow([joint], [0.1])


def test_stands_where_it_began(humanoid: Humanoid) -> None:
    """It stands at home, still."""
    humanoid.run(50)
    assert humanoid.phase == 'stand'
    assert np.abs(humanoid.positions_rad[-1] - humanoid.positions_rad[0]).max() < 0.05


def test_walks_and_swings_a_claimed_arm(humanoid: Humanoid) -> None:
    """It walks while somebody else moves an arm."""
    for _ in range(200):
        humanoid.control.follow(['left_elbow'], [-1.4])
        humanoid.run(1, 0.2)
    assert humanoid.phase == 'walk'
    assert humanoid.joint_rad('left_elbow') == pytest.approx(-1.4, abs=0.01)
    status = humanoid.walker.status
    assert status is not None and status.odometry.pose.position_m.real > 0.03


def test_stop_in_a_step(humanoid: Humanoid) -> None:
    """A stop lets it finish its steps, holds the arms, and hears no velocity."""
    humanoid.run(200, 0.2)
    humanoid.control.hold_still(True)
    humanoid.run(60, 0.2)
    elbow_rad = humanoid.joint_rad('left_elbow')
    humanoid.run(300, 0.2)
    assert humanoid.phase == 'stand'
    assert humanoid.joint_rad('left_elbow') == pytest.approx(elbow_rad, abs=1e-3)
    humanoid.control.hold_still(False)
    humanoid.run(150, 0.2)
    assert humanoid.phase == 'walk'


def test_mode_changes_at_rest(humanoid: Humanoid) -> None:
    """From a walk it comes to a stand before it holds, and can walk again later."""
    humanoid.run(200, 0.2)
    humanoid.control.manager.switch('hold')
    humanoid.run(1, 0.2)
    assert humanoid.control.manager.mode == 'walking'
    humanoid.run(400, 0.2)
    assert humanoid.control.manager.mode == 'hold' and humanoid.phase == 'stand'
    humanoid.control.manager.switch('walking')
    humanoid.run(200, 0.2)
    assert humanoid.phase == 'walk'
    steps = np.abs(np.diff(humanoid.positions_rad, axis=0))
    assert steps.max() < 0.12, 'no joint jumps'


def test_reset(humanoid: Humanoid) -> None:
    """A reset in the middle of a walk makes it stand at home, where odometry begins."""
    humanoid.run(200, 0.2)
    humanoid.loop.reset()
    humanoid.run(60)
    assert humanoid.phase == 'stand'
    assert humanoid.joint_rad('left_knee') == pytest.approx(
        humanoid.robot.home_rad['left_knee'], abs=0.05
    )
    status = humanoid.walker.status
    assert status is not None and abs(status.odometry.pose.position_m) < 0.01


class StubWalker:
    """Counts what it is told; a fall makes it forget its velocity by itself."""

    def __init__(self) -> None:
        self.robot = SimpleNamespace(joints=('knee',))
        self.velocity = STANDING
        self.commands = 0

    def command(self, velocity: VelocityCommand) -> None:
        """Take a velocity."""
        self.velocity = velocity
        self.commands += 1


def test_the_same_velocity_is_passed_on_once() -> None:
    """It comes at every tick, and changes seldom."""
    walker = StubWalker()
    controller = WalkingController(walker)
    for _ in range(3):
        controller.walk(AHEAD)
    assert (walker.velocity, walker.commands) == (AHEAD, 1)


def test_a_walker_that_forgot_is_told_again() -> None:
    """After a fall it goes on as whoever drives says, without a change of velocity."""
    walker = StubWalker()
    controller = WalkingController(walker)
    controller.walk(AHEAD)
    walker.velocity = STANDING
    controller.walk(AHEAD)
    assert walker.velocity == AHEAD
