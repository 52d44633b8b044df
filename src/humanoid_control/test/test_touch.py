# SPDX-License-Identifier: Apache-2.0
"""Check what the limbs feel of things that they touch."""

from __future__ import annotations

import math

from humanoid_control.walking.obstacle_guard import NOTHING, Touch
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import LEFT, Point, RIGHT
from humanoid_control.walking.touch import TouchObserver
from humanoid_control.walking.walking_robot import Attitude, HomePosture, RobotState, WalkingRobot
from humanoid_description.drives import load_drives
from humanoid_description.robot import Robot
from humanoid_description.rotations import from_rpy
import numpy as np
import pytest

P = WalkParameters()
TICK_S = 0.01
YAW_RAD = 0.7
ELBOW, KNEE = 'left_forearm', 'right_shank'


class Mover:
    """A robot that swings all its joints, accelerated as a walking one, and is pushed at will."""

    def __init__(self, robot: Robot) -> None:
        """Begin at rest."""
        drives = load_drives()
        self.robot = WalkingRobot.of(robot, drives, tuple(drives))
        self._home = HomePosture.of(self.robot, P).positions_rad
        self._phases = np.linspace(0.0, 5.0, len(self._home))
        self.observer = TouchObserver(self.robot, P)
        self.time_s = 0.0
        self.touch = NOTHING

    def move(
        self, time_s: float, link: str = '', force_n: Point = 0j, tick_s: float = TICK_S
    ) -> Touch:
        """Let time pass while a horizontal force acts on the origin of a link."""
        for _ in range(round(time_s / tick_s)):
            self.time_s += tick_s
            self.touch = self.observer.update(self._sensed(link, force_n))
        return self.touch

    def stand(self, time_s: float, link: str, force_n: Point) -> None:
        """Let time pass in which the robot does not walk."""
        for _ in range(round(time_s / TICK_S)):
            self.time_s += TICK_S
            self.observer.rest(self._sensed(link, force_n))

    def _sensed(self, link: str, force_n: Point) -> RobotState:
        """Return what is sensed at a moment; the drives exert what the motion needs."""
        angle, rate = 4.0 * self.time_s + self._phases, 4.0
        state = self.robot.body.state(
            from_rpy(0.02, -0.03, YAW_RAD),
            np.zeros(3),
            self._home + 0.1 * np.sin(angle),
            0.1 * rate * np.cos(angle),
        )
        acceleration = np.array([0.8 * math.cos(9.0 * self.time_s), 0.5, 0.0])
        base = np.concatenate([acceleration, np.zeros(3)])
        _, efforts = state.required(base, -0.1 * rate**2 * np.sin(angle))
        if link:
            push = np.array([force_n.real, force_n.imag, 0.0])
            efforts = efforts - state.efforts_of_force_nm(link, state.position_m(link), push)
        level = Attitude(0.02, -0.03, YAW_RAD, (0.0, 0.0, 0.0))
        return RobotState(self.time_s, state, level, (0.5, 0.5), (0j, 0j), efforts, acceleration)


@pytest.fixture(name='mover')
def _mover(robot: Robot) -> Mover:
    """Return a robot that moves and touches nothing."""
    mover = Mover(robot)
    mover.move(0.3)
    return mover


def felt(touch: Touch) -> list[Point]:
    """Return what all four limbs feel."""
    return [*touch.legs_nm, *touch.arms_nm]


def test_who_only_moves_touches_nothing(mover: Mover) -> None:
    """The efforts of swinging limbs are not taken for a touch."""
    assert max(map(abs, felt(mover.touch))) < 0.5
    assert max(map(abs, felt(mover.move(0.2)))) < 0.5


@pytest.mark.parametrize('force_n', [-30.0 + 0j, 20.0 - 20.0j])
def test_an_arm_feels_which_way_it_is_pushed(mover: Mover, force_n: Point) -> None:
    """The moment about its shoulder points as the force does; no other limb feels it."""
    touch = mover.move(0.3, ELBOW, force_n)
    arm_nm = touch.arms_nm[LEFT]
    assert abs(arm_nm) > P.obstacles.arm_touch_nm
    assert abs(arm_nm / abs(arm_nm) - force_n / abs(force_n)) < 0.3
    assert max(map(abs, [*touch.legs_nm, touch.arms_nm[RIGHT]])) < 0.5


def test_a_leg_feels_what_stops_its_knee(mover: Mover) -> None:
    """So it need not be the foot that meets something; when that is gone, it is forgotten."""
    touch = mover.move(0.3, KNEE, -80.0j)
    assert touch.legs_nm[RIGHT].imag < -P.obstacles.leg_touch_aside_nm
    assert abs(touch.legs_nm[LEFT]) < 0.5
    assert abs(mover.move(0.3).legs_nm[RIGHT]) < 0.5


def test_a_touch_is_felt_within_a_tenth_of_a_second(mover: Mover) -> None:
    """So soon, at any rate of the control."""
    assert (
        abs(mover.move(0.1, KNEE, -80.0j, 0.005).legs_nm[RIGHT]) > P.obstacles.leg_touch_aside_nm
    )


def test_after_a_gap_nothing_is_known(mover: Mover) -> None:
    """Differences over a stall of the control say nothing of accelerations."""
    mover.time_s += 0.1
    assert mover.move(TICK_S, KNEE, -80.0j) == NOTHING


def test_a_load_in_a_hand_is_no_touch(robot: Robot) -> None:
    """It is learned while the robot stands; what pushes the arm afterwards is felt on top."""
    mover = Mover(robot)
    mover.stand(4.0, ELBOW, 40.0 + 0j)
    loaded = mover.move(0.5, ELBOW, 40.0 + 0j)
    assert abs(loaded.arms_nm[LEFT]) < 0.3 * P.obstacles.arm_touch_nm
    pushed = mover.move(0.5, ELBOW, 80.0 + 0j)
    alone = Mover(robot).move(0.5, ELBOW, 40.0 + 0j)
    assert abs(pushed.arms_nm[LEFT]) == pytest.approx(abs(alone.arms_nm[LEFT]), rel=0.25)
