# SPDX-License-Identifier: Apache-2.0
"""
Feel with which limbs the robot touches something.

What the drives exert accelerates the limbs and holds them against gravity; inverse dynamics says
how much of it. The rest is what the limbs touch: A. De Luca et al., "Collision detection and safe
reaction with the DLR-III lightweight manipulator arm", IROS 2006, here with accelerations from
differences, a low-pass filter behind them, and a root that moves as the inertial sensor says.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import Point
from humanoid_control.walking.sides import NAMES
from humanoid_control.walking.state_estimator import RobotState
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Touch:
    """
    How limbs are pushed, left and right: where to, and the moment (Nm) about hip or shoulder.

    A foot on the ground pushes its leg as well; so legs count while they are in the air.
    """

    legs_nm: tuple[Point, Point] = (0j, 0j)
    arms_nm: tuple[Point, Point] = (0j, 0j)


NOTHING = Touch()


class TouchObserver:
    """
    Contact observer: compares the efforts of all joints with what their motion needs.

    Parameters
    ----------
    robot
        The robot, with the dynamics of its body.
    parameters : WalkParameters
        The gait, which has the rates of the low-pass filters and the longest gap.

    Raises
    ------
    DynamicsError
        The robot lacks a joint of the hips or shoulders.

    """

    def __init__(self, robot: WalkingRobot, parameters: WalkParameters) -> None:
        self._parameters = parameters
        self._hips = _joints(robot, 'hip_pitch', 'hip_roll')
        self._shoulders = _joints(robot, 'shoulder', 'shoulder_roll')
        self._arms = [joint for joints in self._shoulders for joint in joints]
        self._last: RobotState | None = None
        self._outside_nm: Array = np.zeros(len(robot.body.joints))
        self._borne_nm: Array = np.zeros_like(self._outside_nm)
        """(n,) what arms bore while the robot stood: a load, and a hand that is bent."""

    def rest(self, sensed: RobotState) -> None:
        """
        Learn what load the arms bear while the robot stands.

        All other contacts are forgotten: a robot that stands cannot walk into anything.

        Parameters
        ----------
        sensed
            The estimated state of the robot.

        """
        self._follow(self._borne_nm, sensed, self._parameters.obstacles.touch_load_rate_1_s)
        self._outside_nm[:] = 0.0
        self._outside_nm[self._arms] = self._borne_nm[self._arms]

    def update(self, sensed: RobotState) -> Touch:
        """
        Estimate the moments of external contacts about hips and shoulders.

        Parameters
        ----------
        sensed
            The estimated state of the robot.

        Returns
        -------
        Touch
            In the plane of the odom frame; zero at the first observation and after a gap.

        """
        if not self._follow(self._outside_nm, sensed, self._parameters.obstacles.touch_rate_1_s):
            return NOTHING
        ahead = cmath.rect(1.0, sensed.attitude.yaw_rad)
        legs = [self._moment(*joints, ahead, 0.0) for joints in self._hips]
        arms = [self._moment(*joints, ahead, self._borne_nm) for joints in self._shoulders]
        return Touch((legs[0], legs[1]), (arms[0], arms[1]))

    def _follow(self, followed_nm: Array, sensed: RobotState, rate_1_s: float) -> bool:
        """Let an estimate (n,) follow what comes from outside; return whether that is known."""
        last, self._last = self._last, sensed
        passed_s = sensed.time_s - last.time_s if last else 0.0
        if last is None or not 0.0 < passed_s <= self._parameters.obstacles.touch_gap_s:
            return False
        share = -math.expm1(-rate_1_s * passed_s)
        followed_nm += share * (_outside(last, sensed, passed_s) - followed_nm)
        return True

    def _moment(self, pitch: int, roll: int, ahead: Point, borne_nm: Array | float) -> Point:
        """
        Return the moment of a horizontal force below a joint, in the direction of the force.

        What is borne anyway is no such force.
        """
        outside_nm = self._outside_nm - borne_nm
        return complex(-outside_nm[pitch], outside_nm[roll]) * ahead


def _outside(last: RobotState, now: RobotState, passed_s: float) -> Array:
    """Return the mean efforts (n,) between two moments that come from outside."""
    state = now.state
    turned = state.base_angular_velocity_rad_s - last.state.base_angular_velocity_rad_s
    base = np.concatenate([now.acceleration_m_s2, turned / passed_s])
    gained = state.velocities_rad_s - last.state.velocities_rad_s
    _, needed_nm = state.required(base, gained / passed_s)
    outside: Array = needed_nm - (last.efforts_nm + now.efforts_nm) / 2
    return outside


def _joints(robot: WalkingRobot, pitch: str, roll: str) -> Sequence[tuple[int, int]]:
    """Return the indices of two joints, left and right, among all."""
    return [(robot.index(f'{side}_{pitch}'), robot.index(f'{side}_{roll}')) for side in NAMES]
