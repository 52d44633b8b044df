# SPDX-License-Identifier: Apache-2.0
"""Where all joints go: legs from pelvis and soles, arms from the legs."""

from __future__ import annotations

from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.leg_ik import leg_posture
from humanoid_control.dynamics.rotations import about_z
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.home_posture import HomePosture
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.sides import LEFT, NAMES, RIGHT, SIDES
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class WholeBody:
    """Computes the targets of all joints of a robot."""

    def __init__(self, robot: WalkingRobot, home: HomePosture, parameters: WalkParameters) -> None:
        """Find the joints."""
        self._robot = robot
        self._home = home
        self._shoulders = [robot.index(f'{name}_shoulder') for name in NAMES]
        self._swing_rad_m = parameters.arm_swing / home.base_height_m

    def targets(
        self,
        wanted: Frame,
        measured: Frame,
        footing: Footing,
        swing: tuple[int, PlanarPose, float] | None,
    ) -> Array:
        """
        Return the positions (n,) wanted.

        Feet on the ground move the pelvis where it is wanted. A foot in the air is placed from
        where the pelvis is, so that it lands where planned even if the pelvis is elsewhere.
        """
        positions: Array = self._home.positions_rad.copy()
        for side in SIDES:
            if swing and swing[0] == side:
                self._place(side, measured, swing[1], swing[2], positions)
            else:
                foothold = footing[side]
                self._place(side, wanted, foothold.pose, foothold.lift_m, positions)
        self._swing_arms(footing, swing, positions)
        return positions

    def _place(
        self, side: int, base: Frame, sole: PlanarPose, height_m: float, positions: Array
    ) -> None:
        """Set the joints of a leg so that its sole is level in a place."""
        leg, point = self._robot.legs[side], sole.position_m
        place = Frame(np.array([point.real, point.imag, height_m]), about_z(sole.yaw_rad))
        posture = leg_posture(leg.geometry, place.seen_from(base))
        positions[leg.indices] = posture.positions_rad

    def _swing_arms(
        self, footing: Footing, swing: tuple[int, PlanarPose, float] | None, positions: Array
    ) -> None:
        """Let each arm go with the opposite foot, so that their turns about z cancel."""
        feet = [footing.pose(side) for side in SIDES]
        if swing:
            feet[swing[0]] = swing[1]
        middle = feet[LEFT].halfway(feet[RIGHT])
        ahead_m = middle.local(feet[LEFT].position_m).real * 2.0
        for side, direction in zip(SIDES, (1.0, -1.0)):
            positions[self._shoulders[side]] += direction * self._swing_rad_m * ahead_m
