# SPDX-License-Identifier: Apache-2.0
"""Whole-body inverse kinematics: base from the centre of mass, legs from base and soles, arms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.leg_ik import leg_posture, leg_rates, LegGeometry
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.odometry import BaseEstimate, BaseMotion
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.planar import LEFT, NAMES, RIGHT, SIDES, Turning
from humanoid_control.walking.swing_foot import SoleMotion, Swing
from humanoid_control.walking.walking_robot import HomePosture, WalkingRobot
from humanoid_description.rotations import about_y, about_z, skew
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


def base_below(
    wanted: Motion,
    height_m: float,
    turning: Turning,
    com: Motion,
    base: BaseEstimate,
    state: BodyState,
    pitch_rad: float = 0.0,
    pitch_rate_rad_s: float = 0.0,
) -> BaseMotion:
    """
    Compute the motion of the base that gives the centre of mass its target motion.

    Parameters
    ----------
    wanted
        Target motion of the centre of mass over the ground, in the odom frame.
    height_m
        Target height of the centre of mass, in the odom frame.
    turning
        Target heading of the base, and its rate.
    com, base, state
        Estimates of the centre of mass, the base and the posture: they give the position of the
        centre of mass relative to the base.
    pitch_rad, pitch_rate_rad_s
        Target pitch of the base, positive when it is bent forward, and its rate; upright by
        default.

    Returns
    -------
    BaseMotion
        Pose and twist of the base, in the odom frame.

    """
    heading = about_z(turning.heading_rad)
    rotation = heading @ about_y(pitch_rad)
    upright = rotation @ state.base_rotation.T
    from_base = np.array([com.position_m.real, com.position_m.imag, 0.0]) - base.position_m
    from_base[2] = state.com_m[2]
    to_com = upright @ from_base
    # Velocity of the centre of mass in the base by the joints, without the rotation of the base.
    shifting = upright @ (
        state.com_velocity_m_s - skew(state.base_angular_velocity_rad_s) @ state.com_m
    )
    place, speed = wanted.position_m, wanted.velocity_m_s
    turn = pitch_rate_rad_s * heading[:, 1] + np.array([0.0, 0.0, turning.rate_rad_s])
    velocity = np.array([speed.real, speed.imag, 0.0]) - shifting - skew(turn) @ to_com
    goal = np.array([place.real, place.imag, height_m])
    return BaseMotion(Frame(goal - to_com, rotation), Twist(velocity, turn))


def within_reach(
    base: BaseMotion, robot: WalkingRobot, footing: Footing, sides: Sequence[int], reach: float
) -> BaseMotion:
    """
    Lower the base until the legs on the ground reach their footholds.

    Parameters
    ----------
    base
        Target motion of the base, in the odom frame.
    robot
        The robot, with the geometry of its legs.
    footing, sides
        Footholds of the feet, and the sides of those that carry the robot.
    reach
        Fraction of its length to which a leg may be stretched.

    Returns
    -------
    BaseMotion
        The same motion, lowered if necessary.

    """
    legs = [robot.legs[side].geometry for side in sides]
    soles = [footing[side].sole_m for side in sides]
    x, y, _ = base.frame.position_m.tolist()
    height_m = reachable_height_m(base.frame, legs, soles, reach)
    return BaseMotion(Frame(np.array([x, y, height_m]), base.frame.rotation), base.twist)


def reachable_height_m(
    base: Frame, legs: Sequence[LegGeometry], soles_m: Sequence[Array], reach: float
) -> float:
    """
    Compute the height of the base at which all legs reach their soles.

    The base is moved along the vertical only, and never up.

    Parameters
    ----------
    base
        Pose of the base, in the same frame as the soles.
    legs
        Geometry of the legs on the ground.
    soles_m
        Positions (3,) of their soles, which are level, one for each leg.
    reach
        Fraction of its length to which a leg may be stretched.

    Returns
    -------
    float
        Height of the base in m, in the frame of the soles.

    """
    height_m = float(base.position_m[2])
    for leg, sole in zip(legs, soles_m):
        hip = base.rotation @ leg.hip_m
        x, y, _ = (base.position_m + hip - sole).tolist()
        stretched_m = reach * leg.length_m
        up_m = math.sqrt(max(0.0, stretched_m**2 - x**2 - y**2))
        ankle_m = float(sole[2] + leg.ankle_m[2])
        height_m = min(height_m, ankle_m + up_m - float(hip[2]))
    return height_m
