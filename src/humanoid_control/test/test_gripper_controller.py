# SPDX-License-Identifier: Apache-2.0
"""Open and close a gripper, with something between its fingers or nothing."""

from __future__ import annotations

import math

from humanoid_control.backends import JointLimits, JointTargets
from humanoid_control.controllers import (
    CommandError,
    follow_mode,
    GripperController,
    GripResult,
    hold_mode,
)
from humanoid_control.controllers.gripper_controller import gripper_controllers
from humanoid_control.hosting.controller_switch import controllers_of, Strictness, switch
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.mock_backend import MockBackend
from humanoid_description.drives import load_drives
import pytest

DRIVES = {
    name: drive for name, drive in load_drives(hands=True).items() if name.startswith('right')
}
JOINTS = tuple(DRIVES)
FINGER = JOINTS.index('right_gripper')
NAME = 'right_gripper_controller'
PERIOD_S = 0.01


class Hand:
    """A robot with a gripper; what is between the fingers stops them."""

    def __init__(self, gap_m: float = 0.0) -> None:
        """Begin closed, or at a gap; all joints are held."""
        self.backend = MockBackend(DRIVES, period_s=PERIOD_S, home_rad={JOINTS[FINGER]: gap_m / 2})
        limits = JointLimits.of(DRIVES, JOINTS)
        self.control = RobotControl(JOINTS, limits, [follow_mode(JOINTS), hold_mode(JOINTS)])
        self.held_m = 0.0
        """The width of what is between the fingers."""
        self.told: list[JointTargets] = []

    @property
    def gripper(self) -> GripperController:
        """Return its controller."""
        return self.control.goals.grippers[NAME]

    @property
    def press_n(self) -> float:
        """Return the force with which the servo presses what it was told last."""
        at_m = max(float(self.backend.observe()[''].positions_rad[FINGER]), self.held_m / 2)
        way_m = at_m - float(self.told[-1].positions_rad[FINGER])
        return DRIVES['right_gripper'].kp * way_m

    def run(self, seconds: float) -> None:
        """Let time pass."""
        for _ in range(round(seconds / PERIOD_S)):
            observation = self.backend.observe()['']
            at_m = observation.positions_rad[FINGER]
            observation.positions_rad[FINGER] = max(at_m, self.held_m / 2)
            self.told.append(self.control.update(observation))
            self.backend.step({'': self.told[-1]})

    def grip(self, gap_m: float, most_n: float = 0.0) -> list[GripResult]:
        """Give a goal; return where its end comes."""
        results: list[GripResult] = []
        self.gripper.accept(self.control.goals.checked_grip(NAME, gap_m, most_n), results.append)
        return results


def test_each_hand_has_its_controller() -> None:
    """A robot without hands has none; a prefix is no matter."""
    for prefix in ('', 'left_r_'):
        drives = load_drives(prefix=prefix, hands=True)
        found = gripper_controllers(tuple(drives), JointLimits.of(drives, tuple(drives)))
        assert {each.name: each.own for each in found} == {
            'left_gripper_controller': (f'{prefix}left_gripper',),
            'right_gripper_controller': (f'{prefix}right_gripper',),
        }
    bare = load_drives()
    assert gripper_controllers(tuple(bare), JointLimits.of(bare, tuple(bare))) == ()


def test_a_gap_is_reached_and_stays() -> None:
    """Whether it is told so or not, the gripper is as wide as was asked for."""
    hand = Hand()
    results = hand.grip(0.08)
    hand.run(2.0)
    (end,) = results
    assert end.has_ended_well and end.state.reached_goal and not end.state.stalled
    assert end.state.gap_m == pytest.approx(0.08, abs=0.003)
    hand.run(3.0)
    assert hand.gripper.state.gap_m == pytest.approx(0.08, abs=0.001)


def test_what_is_held_stops_the_fingers_and_stays_held() -> None:
    """The goal ends well, and says how wide that is; the fingers go on to press."""
    hand = Hand(0.1)
    hand.held_m = 0.06
    results = hand.grip(0.0, 15.0)
    hand.run(3.0)
    (end,) = results
    assert end.has_ended_well and end.state.stalled and not end.state.reached_goal
    assert end.state.gap_m == pytest.approx(0.06, abs=0.001)
    assert hand.press_n == pytest.approx(15.0)
    hand.held_m = 0.04
    hand.run(1.0)
    assert hand.gripper.state.gap_m == pytest.approx(0.04, abs=0.001)
    assert hand.press_n == pytest.approx(15.0)


def test_no_more_than_the_drive_can() -> None:
    """Of more than it has, it gives all; of nothing said, too."""
    for most_n in (0.0, 1000.0):
        hand = Hand(0.1)
        hand.held_m = 0.06
        hand.grip(0.0, most_n)
        hand.run(3.0)
        assert hand.press_n == pytest.approx(DRIVES['right_gripper'].effort)


def test_fingers_do_not_move_faster_than_they_can() -> None:
    """The way of a target in a period is that of the greatest speed, at most."""
    hand = Hand()
    hand.grip(0.1)
    hand.run(1.0)
    way = [float(each.positions_rad[FINGER]) for each in hand.told]
    fastest = max(abs(b - a) for a, b in zip(way, way[1:])) / PERIOD_S
    assert 0.05 < fastest <= DRIVES['right_gripper'].velocity * 1.001


def test_cancel_holds_the_fingers_where_they_are() -> None:
    """They go no further."""
    hand = Hand()
    results = hand.grip(0.1)
    hand.run(0.3)
    hand.gripper.cancel_goal()
    (end,) = results
    assert end.is_canceled
    hand.run(1.0)
    there_m = hand.gripper.state.gap_m
    assert 0.005 < there_m < 0.09
    hand.run(1.0)
    assert hand.gripper.state.gap_m == pytest.approx(there_m, abs=0.001)


def test_a_newer_goal_takes_the_place_of_the_old_one() -> None:
    """The old one says so, and the new one is done."""
    hand = Hand()
    first = hand.grip(0.1)
    hand.run(0.1)
    second = hand.grip(0.02)
    hand.run(2.0)
    assert not first[0].has_ended_well and 'newer goal' in first[0].message
    assert second[0].state.reached_goal
    assert hand.gripper.state.gap_m == pytest.approx(0.02, abs=0.003)


def test_a_stop_ends_the_goal_but_drops_nothing() -> None:
    """What is held is pressed as before, and no goal is taken meanwhile."""
    hand = Hand(0.1)
    hand.held_m = 0.06
    hand.grip(0.0, 20.0)
    hand.run(1.0)
    opening = hand.grip(0.1)
    hand.run(0.01)
    hand.control.hold_still(True)
    hand.run(1.0)
    assert not opening[0].has_ended_well
    with pytest.raises(CommandError, match='must hold still'):
        hand.grip(0.0)
    hand.control.hold_still(False)
    hand.run(1.0)
    assert hand.gripper.state.gap_m < 0.07


def test_a_gripper_that_is_switched_off_takes_no_goal() -> None:
    """It is listed as what MoveIt looks for, and gives its joint back."""
    hand = Hand()
    hand.grip(0.05)
    hand.run(1.0)
    (info,) = [each for each in controllers_of(hand.control) if each.name == NAME]
    assert info.kind == 'position_controllers/GripperActionController'
    assert info.claimed == ('right_gripper',) and info.is_active
    assert switch(hand.control, [], [NAME], Strictness.STRICT) == (True, '')
    with pytest.raises(CommandError, match='inactive'):
        hand.grip(0.0)


@pytest.mark.parametrize(
    ('gap_m', 'most_n', 'part'),
    [
        (0.11, 0.0, 'give 0 to 0.1 m, not 0.11'),
        (-0.01, 0.0, 'give 0 to 0.1 m'),
        (math.nan, 0.0, 'give 0 to 0.1 m, not nan'),
        (0.05, -1.0, 'max_effort is -1 N'),
        (0.05, math.inf, 'max_effort is inf N'),
        (0.05, math.nan, 'max_effort is nan N'),
    ],
)
def test_what_no_gripper_can_do_is_refused(gap_m: float, most_n: float, part: str) -> None:
    """With a sentence that says what can be."""
    with pytest.raises(CommandError, match=part):
        Hand().grip(gap_m, most_n)
