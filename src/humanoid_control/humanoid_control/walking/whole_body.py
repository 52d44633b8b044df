# SPDX-License-Identifier: Apache-2.0
"""Where all joints go: legs from pelvis and soles, arms from the legs."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.leg_ik import leg_posture
from humanoid_control.dynamics.rotations import about_z
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.home_posture import HomePosture
from humanoid_control.walking.joint_motion import JointMotion
from humanoid_control.walking.leg_map import LegMap
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import dot, PlanarPose
from humanoid_control.walking.sides import LEFT, NAMES, outwards, RIGHT, SIDES
from humanoid_control.walking.swing_foot import Swing
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_STILL: Array = np.zeros(6)


@dataclass(frozen=True, eq=False)
class MovingBase:
    """Where the base is, and its velocity (6,): linear, then angular, in the world's axes."""

    frame: Frame
    velocity: Array


class WholeBody:
    """Computes the motion of all joints of a robot."""

    def __init__(self, robot: WalkingRobot, home: HomePosture, parameters: WalkParameters) -> None:
        """Find the joints."""
        self._robot = robot
        self._home = home
        self._shoulders = [robot.index(f'{name}_shoulder') for name in NAMES]
        self._swing_rad_m = parameters.arm_swing / home.base_height_m
        self._limit_rad_s = parameters.velocity_limit_rad_s

    def motion(
        self,
        wanted: MovingBase,
        measured: MovingBase,
        footing: Footing,
        swing: Swing | None,
        maps: Sequence[LegMap],
    ) -> JointMotion:
        """
        Return how the joints are to move.

        Feet on the ground move the pelvis where it is wanted. A foot in the air is placed from
        where the pelvis is, so that it lands where planned even if the pelvis is elsewhere.
        """
        still = np.zeros(len(self._home.positions_rad))
        motion = JointMotion(self._home.positions_rad.copy(), still, still.copy())
        for side, leg in zip(SIDES, maps):
            if swing and swing.side == side:
                height_m = swing.lift.height_m
                self._place(side, measured.frame, swing.pose, height_m, motion.positions_rad)
                rates = leg.rates(swing.velocity6, measured.velocity)
            else:
                foothold, at = footing[side], motion.positions_rad
                self._place(side, wanted.frame, foothold.pose, foothold.lift_m, at)
                rates = leg.rates(_STILL, wanted.velocity)
            limit = self._limit_rad_s
            motion.velocities_rad_s[leg.indices] = np.clip(rates, -limit, limit)
        self._swing_arms(footing, swing, motion)
        return motion

    def _place(
        self, side: int, base: Frame, sole: PlanarPose, height_m: float, positions: Array
    ) -> None:
        """Set the joints of a leg so that its sole is level in a place."""
        leg, point = self._robot.legs[side], sole.position_m
        place = Frame(np.array([point.real, point.imag, height_m]), about_z(sole.yaw_rad))
        posture = leg_posture(leg.geometry, place.seen_from(base))
        positions[leg.indices] = posture.positions_rad

    def _swing_arms(self, footing: Footing, swing: Swing | None, motion: JointMotion) -> None:
        """Let each arm go with the opposite foot, so that their turns about z cancel."""
        feet = [footing.pose(side) for side in SIDES]
        speed, gain = 0j, 0j
        if swing:
            feet[swing.side] = swing.pose
            sign = outwards(swing.side)
            speed, gain = sign * swing.velocity.linear, sign * swing.acceleration.linear
        middle = feet[LEFT].halfway(feet[RIGHT])
        ahead = cmath.rect(self._swing_rad_m, middle.yaw_rad)
        way = feet[LEFT].position_m - feet[RIGHT].position_m
        for shoulder, direction in zip(self._shoulders, (1.0, -1.0)):
            motion.positions_rad[shoulder] += direction * dot(way, ahead)
            motion.velocities_rad_s[shoulder] = direction * dot(speed, ahead)
            motion.accelerations_rad_s2[shoulder] = direction * dot(gain, ahead)
