# SPDX-License-Identifier: Apache-2.0
"""Check that each joint has one owner, and changes it smoothly."""

from __future__ import annotations

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers import (
    CommandError,
    ControllerManager,
    follow_mode,
    Follower,
    Hold,
    hold_mode,
    JointNames,
    Mode,
)
from humanoid_control.controllers.modes import Still
from humanoid_control.testing import JOINTS, LIMITS, observed, PERIOD_S, targets
import numpy as np
import pytest

NAMES = JointNames(JOINTS)


class Swinging:
    """A stand-in for walking: every joint at the sine of the time."""

    name, joints = 'walking', JOINTS

    def __init__(self) -> None:
        """Begin without a fault."""
        self.fault = 0.0
        self.at_rest = True
        self.trouble = ''
        self.starts = self.forgets = 0

    def start(self, observation: Observation, held: JointTargets) -> None:
        """Count the starts."""
        self.starts += 1

    def forget(self) -> None:
        """Count how often it is told to forget."""
        self.forgets += 1

    def update(self, observation: Observation) -> JointTargets:
        """Return the targets of the moment."""
        now_s = observation.time_s
        told = targets(*[0.3 * np.sin(now_s)] * 3, velocity_rad_s=0.3 * np.cos(now_s))
        told.positions_rad[0] += self.fault
        return told


class Robot:
    """A manager, a clock, and all that it has told the joints."""

    def __init__(self) -> None:
        """Begin to walk."""
        self.walking, self.follower = Swinging(), Follower(JOINTS)
        modes = (
            Mode(
                'walking',
                self.walking,
                ('left_elbow', 'right_elbow'),
                may_end=lambda: self.walking.at_rest,
                needs_all_because=lambda: self.walking.trouble,
                forget=self.walking.forget,
            ),
            hold_mode(JOINTS),
            follow_mode(JOINTS),
        )
        self.said: list[str] = []
        self.manager = ControllerManager(JOINTS, modes, (self.follower,), LIMITS, self.said.append)
        self.now_s = 0.0
        self.told: list[JointTargets] = []

    def run(self, periods: int) -> JointTargets:
        """Let time pass; return the last targets."""
        for _ in range(periods):
            self.told.append(self.manager.update(observed(self.now_s)))
            self.now_s += PERIOD_S
        return self.told[-1]

    def command(self, joint: str, position_rad: float) -> None:
        """Command a joint from outside."""
        command = NAMES.targets([joint], [position_rad])
        self.manager.claims.check(self.follower, command.indices)
        self.follower.accept(command)

    def largest_step_rad(self) -> float:
        """Return the largest change of any target in one period."""
        positions_rad = np.array([told.positions_rad for told in self.told])
        return float(np.abs(np.diff(positions_rad, axis=0)).max())

    def largest_jolt_rad_s(self) -> float:
        """Return the largest change of any velocity in one period."""
        velocities = np.array([told.velocities_rad_s for told in self.told])
        return float(np.abs(np.diff(velocities, axis=0)).max())


def test_begins_where_the_robot_is() -> None:
    """The first targets are where the joints are, at rest, whatever the mode asks for."""
    robot = Robot()
    first = robot.manager.update(observed(0.0, 0.3, -0.3, 0.1))
    assert first.positions_rad == pytest.approx([0.3, -0.3, 0.1])
    assert first.velocities_rad_s == pytest.approx([0.0] * 3)


def test_mode_moves_all_joints() -> None:
    """After the blend the targets are those of the mode."""
    robot = Robot()
    told = robot.run(100)
    assert told.positions_rad == pytest.approx([0.3 * np.sin(0.99)] * 3)
    assert robot.manager.claims.owner('left_elbow') == 'walking'


def test_claimed_joint_and_back() -> None:
    """A commanded joint goes to its follower and, when that is silent, back; nothing jumps."""
    robot = Robot()
    robot.run(100)
    robot.told.clear()
    for _ in range(80):
        robot.command('left_elbow', -0.5)
        robot.run(1)
    assert robot.manager.claims.owner('left_elbow') == 'joint_commands'
    assert robot.manager.claims.owner('right_elbow') == 'walking'
    assert robot.manager.claims.owner('left_knee') == 'walking'
    assert robot.told[-1].positions_rad[0] == pytest.approx(-0.5)
    assert robot.told[-1].positions_rad[1] == pytest.approx(0.3 * np.sin(1.79))
    robot.run(120)
    assert robot.manager.claims.owner('left_elbow') == 'walking'
    assert robot.told[-1].positions_rad[0] == pytest.approx(0.3 * np.sin(2.99))
    assert robot.largest_step_rad() < 0.05 and robot.largest_jolt_rad_s() < 0.7
    assert robot.walking.starts == 1, 'walking goes on'


def test_joint_that_cannot_be_claimed() -> None:
    """A command for a joint that walking keeps is refused, with who claims it and the way out."""
    robot = Robot()
    robot.run(1)
    with pytest.raises(CommandError) as refusal:
        robot.command('left_knee', 0.1)
    assert str(refusal.value) == (
        "'left_knee' is claimed by the mode 'walking', which leaves only other joints to "
        "controllers. Leave it out, or set the mode to 'follow'."
    )


@pytest.mark.parametrize('mode', ['hold', 'follow'])
def test_switch_to_rest(mode: str) -> None:
    """A mode that holds stops every joint smoothly, close to where it was."""
    robot = Robot()
    robot.run(100)
    robot.told.clear()
    robot.run(1)
    before = robot.told[-1].positions_rad
    robot.manager.switch(mode)
    told = robot.run(60)
    assert robot.manager.mode == mode
    assert told.positions_rad == pytest.approx(before, abs=0.03)
    assert not told.velocities_rad_s.any()
    assert robot.largest_step_rad() < 0.01 and robot.largest_jolt_rad_s() < 0.05


def test_in_trouble_nothing_can_be_claimed() -> None:
    """A robot that needs all joints takes back what was claimed, and says why."""
    robot = Robot()
    robot.run(1)
    robot.command('left_elbow', -0.5)
    robot.run(1)
    assert robot.manager.claims.owner('left_elbow') == 'joint_commands'
    robot.walking.trouble = 'the robot has fallen'
    robot.run(1)
    assert robot.manager.claims.owner('left_elbow') == 'walking'
    with pytest.raises(CommandError, match='accepts no joint commands now: the robot has fallen.'):
        robot.command('left_elbow', -0.5)
    robot.walking.trouble = ''
    robot.command('left_elbow', -0.5)
    robot.run(1)
    assert robot.manager.claims.owner('left_elbow') == 'joint_commands'


def _robot_that_supports() -> tuple[ControllerManager, Follower, Still]:
    """Return the manager of a robot whose mode exerts 1, 2 and 3 N m, and its claimants."""
    hold, still, follower = Hold(JOINTS), Still(JOINTS), Follower(JOINTS, timeout_s=10.0)
    claimable = JOINTS[:2]
    follow = Mode('follow', Hold(JOINTS), claimable)
    modes = (Mode('walking', hold, claimable, supports=True), follow)
    manager = ControllerManager(JOINTS, modes, (still, follower), LIMITS)
    manager.update(observed(0.0))
    held = JointTargets(np.zeros(3), np.zeros(3), np.array([1.0, 2.0, 3.0]))
    hold.start(observed(0.0), held)
    return manager, follower, still


def _settled(manager: ControllerManager, start_s: float) -> JointTargets:
    """Return the targets after a second."""
    told = manager.update(observed(start_s))
    for number in range(1, 101):
        told = manager.update(observed(start_s + number * PERIOD_S))
    return told


def test_a_mode_that_supports_bears_what_it_lends() -> None:
    """What a claimant exerts comes on top of it."""
    manager, follower, _ = _robot_that_supports()
    follower.accept(NAMES.targets(['left_elbow'], [0.1], [], [4.0]))
    told = _settled(manager, 0.01)
    assert manager.claims.owner('left_elbow') == 'joint_commands'
    assert told.efforts_nm == pytest.approx([5.0, 2.0, 3.0], abs=0.01)


def test_who_holds_still_is_supported_once() -> None:
    """And what carried a load goes on to carry it in a mode that does not."""
    manager, _, still = _robot_that_supports()
    _settled(manager, 0.1)
    still.on = True
    assert _settled(manager, 1.2).efforts_nm == pytest.approx([1.0, 2.0, 3.0])
    manager.switch('follow')
    assert _settled(manager, 2.3).efforts_nm == pytest.approx([1.0, 2.0, 3.0])
    manager.switch('walking')
    assert _settled(manager, 3.4).efforts_nm == pytest.approx([1.0, 2.0, 3.0])


def test_switch_waits_for_rest() -> None:
    """A robot in the middle of a step comes to rest first, and may think better of it."""
    robot = Robot()
    robot.walking.at_rest = False
    robot.run(10)
    robot.manager.switch('hold')
    robot.run(10)
    assert robot.manager.mode == 'walking' and robot.manager.is_leaving
    robot.manager.switch('walking')
    assert not robot.manager.is_leaving
    robot.manager.switch('hold')
    robot.walking.at_rest = True
    robot.run(1)
    assert robot.manager.mode == 'hold' and not robot.manager.is_leaving


def test_followed_joint_stays_where_it_was_left() -> None:
    """In the mode 'follow' a joint whose commander falls silent is held where it is."""
    robot = Robot()
    robot.manager.switch('follow')
    robot.run(1)
    for _ in range(60):
        robot.command('left_knee', 0.4)
        robot.run(1)
    assert robot.run(200).positions_rad == pytest.approx([0.0, 0.0, 0.4])
    assert robot.manager.claims.owner('left_knee') == 'follow'


def test_hold_lends_nothing() -> None:
    """In the mode 'hold' every command is refused."""
    robot = Robot()
    robot.manager.switch('hold')
    robot.run(1)
    with pytest.raises(CommandError, match="mode 'hold', which leaves no joints to controllers"):
        robot.command('left_elbow', 0.1)


def test_a_switch_takes_what_can_no_longer_be_claimed() -> None:
    """Back in the mode 'walking', a knee that was commanded walks again."""
    robot = Robot()
    robot.manager.switch('follow')
    robot.run(1)
    robot.command('left_knee', 0.4)
    robot.run(10)
    robot.manager.switch('walking')
    robot.run(100)
    assert robot.manager.claims.owner('left_knee') == 'walking'
    assert robot.largest_step_rad() < 0.05


def test_unknown_mode() -> None:
    """A mode that there is not is refused with the one that was meant."""
    with pytest.raises(CommandError, match="no mode 'walk'. Did you mean 'walking'?"):
        Robot().manager.switch('walk')


def test_reset() -> None:
    """After a reset it begins anew from where the joints are."""
    robot = Robot()
    robot.run(150)
    before = robot.walking.forgets
    robot.manager.reset()
    told = robot.manager.update(observed(2.0, 0.1, 0.1, 0.1))
    assert told.positions_rad == pytest.approx([0.1] * 3)
    assert robot.walking.starts == 2
    assert robot.walking.forgets == before + 1


def test_late_period() -> None:
    """After a gap in time the targets go on without a jump beyond the speed of the joints."""
    robot = Robot()
    robot.run(100)
    before = robot.told[-1].positions_rad
    robot.now_s += 0.2
    assert np.abs(robot.run(1).positions_rad - before).max() < 0.1


@pytest.mark.parametrize('fault', [np.nan, np.inf])
def test_controller_at_fault(fault: float) -> None:
    """A joint whose controller asks for what is no number is held, and it is said why."""
    robot = Robot()
    told = robot.run(100)
    robot.walking.fault = fault
    after = robot.run(1)
    assert np.isfinite(after.positions_rad).all()
    assert after.positions_rad[0] == pytest.approx(told.positions_rad[0], abs=0.01)
    assert robot.said == [
        "'walking' commands 'left_elbow' to a target that is not finite: the joint is held."
    ]


def test_mode_with_too_few_joints() -> None:
    """A mode must move every joint of the robot."""
    with pytest.raises(ValueError, match='must claim all joints'):
        ControllerManager(JOINTS, [Mode('hold', Hold(JOINTS[:2]), ())], (), LIMITS)
