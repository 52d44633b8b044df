# SPDX-License-Identifier: Apache-2.0
"""Standing posture of the robot, ready to walk."""

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
"""Iterations that put the feet below the centre of mass, which they shift slightly."""


@dataclass(frozen=True, eq=False)
class HomePosture:
    """Standing posture: knees slightly bent, load points of the feet below the centre of mass."""

    positions_rad: Array
    """(n,)"""
    base_height_m: float
    com_height_m: float
    sole_forward_m: float
    """Position of the soles ahead of the base."""

    @classmethod
    def of(cls, robot: WalkingRobot, parameters: WalkParameters) -> HomePosture:
        """
        Compute the posture in which a robot stands, ready to walk.

        Moving the feet shifts the centre of mass as well: they are put below it iteratively.

        Parameters
        ----------
        robot, parameters
            The robot, and the gait parameters of its size, with crouch, step width and arms.

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
    """Put the feet side by side, flat, at an offset ahead of and below the base."""
    for side, leg in zip(SIDES, robot.legs):
        left_m = outwards(side) * parameters.footsteps.width_m / 2
        sole = Frame(np.array([forward_m, left_m, -height_m]), np.eye(3))
        positions[leg.indices] = leg_posture(leg.geometry, sole).positions_rad


def _com(robot: WalkingRobot, positions: Array) -> Array:
    """Compute the centre of mass (3,) relative to the upright base."""
    still = np.zeros(len(positions))
    return robot.body.state(np.eye(3), np.zeros(3), positions, still).com_m


def _stretched_height(robot: WalkingRobot) -> float:
    """Compute the height of the base on stretched legs."""
    still = np.zeros(len(robot.body.joints))
    state = robot.body.state(np.eye(3), np.zeros(3), still, still)
    return -float(state.position_m(robot.legs[0].sole)[2])
