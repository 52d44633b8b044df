# SPDX-License-Identifier: Apache-2.0
"""Whole-body inverse kinematics: legs from pelvis and soles, arms from the legs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.leg_ik import leg_posture
from humanoid_control.dynamics.leg_rates import leg_rates
from humanoid_control.walking.base_motion import BaseMotion
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.home_posture import HomePosture
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.sides import LEFT, NAMES, RIGHT, SIDES
from humanoid_control.walking.swing_foot import SoleMotion, Swing
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class JointMotion:
    """Positions, velocities and accelerations of all joints."""

    positions_rad: Array
    """(n,)"""
    velocities_rad_s: Array
    """(n,)"""
    accelerations_rad_s2: Array
    """(n,); zero for the legs, whose accelerations follow from those of the soles"""


class WholeBody:
    """
    Whole-body inverse kinematics: legs from pelvis and soles, arms that swing with the legs.

    Parameters
    ----------
    robot
        The robot, with the geometry of its legs.
    home
        Standing posture: the shoulders swing about it, and the other joints above the legs
        keep it.
    parameters : WalkParameters
        Gait parameters, with the gain of the arm swing.

    Raises
    ------
    DynamicsError
        The robot lacks a shoulder joint.

    """

    def __init__(self, robot: WalkingRobot, home: HomePosture, parameters: WalkParameters) -> None:
        self._robot = robot
        self._home = home
        self._shoulders = [robot.index(f'{name}_shoulder') for name in NAMES]
        self._swing_rad_m = parameters.posture.arm_swing / home.base_height_m

    def motion(
        self, wanted: BaseMotion, measured: BaseMotion, footing: Footing, swing: Swing | None
    ) -> JointMotion:
        """
        Compute the motion of all joints: inverse kinematics of the legs, and swinging arms.

        The stance legs move the pelvis to its target. The swing foot is placed relative to the
        measured pelvis, so that it lands where planned even if the pelvis is elsewhere.

        Parameters
        ----------
        wanted, measured
            Target motion and measured motion of the base, in the odom frame.
        footing
            Footholds of the feet.
        swing
            Target of the swing foot; None without one.

        """
        positions: Array = self._home.positions_rad.copy()
        joints = JointMotion(positions, np.zeros_like(positions), np.zeros_like(positions))
        soles = [SoleMotion(footing.pose(side), footing[side].plane) for side in SIDES]
        bases = [wanted, wanted]
        if swing:
            soles[swing.side] = swing.sole
            bases[swing.side] = measured
        for side in SIDES:
            self._move_leg(side, bases[side], soles[side], joints)
        self._swing_arms(soles, joints)
        return joints

    def _move_leg(
        self, side: int, base: BaseMotion, sole: SoleMotion, joints: JointMotion
    ) -> None:
        """Set the joints of a leg by inverse kinematics for a sole target."""
        leg, point, speed = self._robot.legs[side], sole.pose.position_m, sole.velocity_m_s
        place = np.array([point.real, point.imag, sole.plane.height_m])
        velocity = np.array([speed.real, speed.imag, sole.climb_m_s])
        turn = np.array([0.0, 0.0, sole.turn_rad_s])
        frame = Frame(place, sole.plane.rotation(sole.pose.yaw_rad)).seen_from(base.frame)
        twist = Twist(velocity, turn).seen_from(base.frame, base.twist, place)
        posture = leg_posture(leg.geometry, frame)
        joints.positions_rad[leg.indices] = posture.positions_rad
        joints.velocities_rad_s[leg.indices] = leg_rates(leg.geometry, posture, frame, twist)

    def _swing_arms(self, soles: Sequence[SoleMotion], joints: JointMotion) -> None:
        """Swing each arm with the opposite foot, so that their yaw momenta cancel."""
        left, right = soles[LEFT], soles[RIGHT]
        middle = left.pose.halfway(right.pose)
        ahead_m = 2.0 * middle.local(left.pose.position_m).real
        speed_m_s = middle.seen(left.velocity_m_s - right.velocity_m_s).real
        gain_m_s2 = middle.seen(left.acceleration_m_s2 - right.acceleration_m_s2).real
        for side, direction in ((LEFT, 1.0), (RIGHT, -1.0)):
            shoulder, gain = self._shoulders[side], direction * self._swing_rad_m
            joints.positions_rad[shoulder] += gain * ahead_m
            joints.velocities_rad_s[shoulder] = gain * speed_m_s
            joints.accelerations_rad_s2[shoulder] = gain * gain_m_s2
