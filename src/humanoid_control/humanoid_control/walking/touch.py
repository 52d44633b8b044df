# SPDX-License-Identifier: Apache-2.0
"""
Contacts of the robot other than its feet on the ground: limbs by torques, the whole by force.

Actuator torques accelerate the limbs and hold them against gravity; inverse dynamics computes
that part. The residual is due to contacts: A. De Luca et al., "Collision detection and safe
reaction with the DLR-III lightweight manipulator arm", IROS 2006, here with accelerations from
finite differences, a low-pass filter after them, and the motion of the root from the IMU.

The momentum of the robot changes by the forces at its feet, which are measured, and by those of
other contacts, which are not. A momentum observer estimates the difference without
differentiation: A. De Luca and R. Mattone, "Actuator failure detection and isolation using
generalized momenta", ICRA 2003, here for the linear momentum in the plane.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass, field
import math

from humanoid_control.walking.obstacle_guard import NOTHING, Touch
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import NAMES, Point
from humanoid_control.walking.walking_robot import RobotState, WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class TouchObserver:
    """
    Contact observer: compares the measured joint torques with inverse dynamics.

    Parameters
    ----------
    robot
        The robot, with the model of its dynamics.
    parameters : WalkParameters
        Gait parameters, with the rates of the low-pass filters and the longest gap.

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
        """(n,) external torques of the arms while the robot stood: a payload, or a bent hand."""

    def rest(self, sensed: RobotState) -> None:
        """
        Estimate the payload of the arms while the robot stands.

        All other contacts are discarded: a robot that stands cannot walk into anything.

        Parameters
        ----------
        sensed
            Estimated state of the robot.

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
            Estimated state of the robot.

        Returns
        -------
        Touch
            Moments in the plane of the odom frame; zero at the first observation and after a gap.

        """
        if not self._follow(self._outside_nm, sensed, self._parameters.obstacles.touch_rate_1_s):
            return NOTHING
        ahead = cmath.rect(1.0, sensed.attitude.yaw_rad)
        legs = [self._moment(*joints, ahead, 0.0) for joints in self._hips]
        arms = [self._moment(*joints, ahead, self._borne_nm) for joints in self._shoulders]
        return Touch((legs[0], legs[1]), (arms[0], arms[1]))

    def _follow(self, followed_nm: Array, sensed: RobotState, rate_1_s: float) -> bool:
        """Low-pass filter the external torques into an estimate (n,); False if unknown."""
        last, self._last = self._last, sensed
        passed_s = sensed.time_s - last.time_s if last else 0.0
        if last is None or not 0.0 < passed_s <= self._parameters.obstacles.touch_gap_s:
            return False
        share = -math.expm1(-rate_1_s * passed_s)
        followed_nm += share * (_outside(last, sensed, passed_s) - followed_nm)
        return True

    def _moment(self, pitch: int, roll: int, ahead: Point, borne_nm: Array | float) -> Point:
        """
        Compute the moment of a horizontal force below a joint, in the direction of the force.

        The payload is subtracted first.
        """
        outside_nm = self._outside_nm - borne_nm
        return complex(-outside_nm[pitch], outside_nm[roll]) * ahead


def _outside(last: RobotState, now: RobotState, passed_s: float) -> Array:
    """Compute the mean external torques (n,) between two states, by inverse dynamics."""
    state = now.state
    turned = state.base_angular_velocity_rad_s - last.state.base_angular_velocity_rad_s
    base = np.concatenate([now.acceleration_m_s2, turned / passed_s])
    gained = state.velocities_rad_s - last.state.velocities_rad_s
    _, needed_nm = state.required(base, gained / passed_s)
    outside: Array = needed_nm - (last.efforts_nm + now.efforts_nm) / 2
    return outside


def _joints(robot: WalkingRobot, pitch: str, roll: str) -> Sequence[tuple[int, int]]:
    """Return the indices of a pitch and a roll joint, for the left and the right side."""
    return [(robot.index(f'{side}_{pitch}'), robot.index(f'{side}_{roll}')) for side in NAMES]


@dataclass
class ForceObserver:
    """Momentum observer of the horizontal external force that does not act on the soles."""

    mass_kg: float
    rate_1_s: float
    """Bandwidth of the estimate."""
    force_n: Point = field(init=False, default=0j)
    """In the axes of the odom frame; against the motion of a robot that walks into an obstacle."""
    _velocity_m_s: Point | None = field(init=False, default=None)

    def update(self, velocity_m_s: Point, ground_n: Point, passed_s: float) -> Point:
        """
        Estimate the horizontal external force with a momentum observer.

        Parameters
        ----------
        velocity_m_s
            Measured velocity of the centre of mass, in the odom frame.
        ground_n
            Measured horizontal force of the ground on the feet, in the axes of the odom frame.
        passed_s
            Time since the last call.

        Returns
        -------
        Point
            Low-pass filtered force in N, in the axes of the odom frame; zero at the first call.

        """
        last, self._velocity_m_s = self._velocity_m_s, velocity_m_s
        if last is not None and passed_s > 0.0:
            change_n = self.mass_kg * (velocity_m_s - last) / passed_s
            share = 1.0 - math.exp(-self.rate_1_s * passed_s)
            self.force_n += share * (change_n - ground_n - self.force_n)
        return self.force_n
