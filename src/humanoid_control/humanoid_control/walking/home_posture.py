# SPDX-License-Identifier: Apache-2.0
"""The posture in which the robot stands, ready to walk."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.frames import Frame
from humanoid_control.dynamics.leg_ik import leg_posture
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.sides import NAMES, outwards, SIDES
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_ROUNDS = 8
"""How often the feet are put under the centre of mass, which they move by little."""


@dataclass(frozen=True, eq=False)
class HomePosture:
    """Knees a little bent, feet side by side, their load points under the centre of mass."""

    positions_rad: Array
    """(n,)"""
    base_height_m: float
    com_height_m: float
    sole_forward_m: float
    """Where the soles are before the base."""

    @classmethod
    def of(cls, robot: WalkingRobot, parameters: WalkParameters) -> HomePosture:
        """
        Compute the posture in which a robot stands, ready to walk.

        Moving the feet shifts the centre of mass as well: they are put below it iteratively.

        Parameters
        ----------
        robot, parameters
            The robot, and the gait of its size, which has the crouch, the step width and the arms.

        Raises
        ------
        DynamicsError
            The robot lacks an elbow or a shoulder roll joint.

        """
        height_m = _stretched_height(robot) - parameters.posture.crouch_m
        positions = np.zeros(len(robot.body.joints))
        _place_arms(robot, parameters, positions)
        forward_m = 0.0
        for _ in range(_ROUNDS):
            _place_legs(robot, parameters, positions, forward_m, height_m)
            com = _com(robot, positions)
            forward_m = float(com[0]) - parameters.posture.zmp_forward_m
        _place_legs(robot, parameters, positions, forward_m, height_m)
        com_height_m = height_m + float(_com(robot, positions)[2])
        return cls(positions, height_m, com_height_m, forward_m)


def _place_arms(robot: WalkingRobot, parameters: WalkParameters, positions: Array) -> None:
    """Bend the elbows, and hold the arms away from the body."""
    for side, name in enumerate(NAMES):
        positions[robot.index(f'{name}_elbow')] = parameters.posture.elbow_rad
        roll_rad = outwards(side) * parameters.posture.shoulder_roll_rad
        positions[robot.index(f'{name}_shoulder_roll')] = roll_rad


def _place_legs(
    robot: WalkingRobot,
    parameters: WalkParameters,
    positions: Array,
    forward_m: float,
    height_m: float,
) -> None:
    """Put the feet side by side, flat, so far before and below the base."""
    for side, leg in zip(SIDES, robot.legs):
        left_m = outwards(side) * parameters.footsteps.width_m / 2
        sole = Frame(np.array([forward_m, left_m, -height_m]), np.eye(3))
        positions[leg.indices] = leg_posture(leg.geometry, sole).positions_rad


def _com(robot: WalkingRobot, positions: Array) -> Array:
    """Return the centre of mass seen from the base, upright."""
    still = np.zeros(len(positions))
    return robot.body.state(np.eye(3), np.zeros(3), positions, still).com_m


def _stretched_height(robot: WalkingRobot) -> float:
    """Return how high the base is on stretched legs."""
    still = np.zeros(len(robot.body.joints))
    state = robot.body.state(np.eye(3), np.zeros(3), still, still)
    return -float(state.position_m(robot.legs[0].sole)[2])
