# SPDX-License-Identifier: Apache-2.0
"""Target motion of the base."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.rotations import about_y, about_z, skew
from humanoid_control.walking.base_estimate import BaseEstimate
from humanoid_control.walking.base_motion import BaseMotion
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.leg_reach import reachable_height_m
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.turning import Turning
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np


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
