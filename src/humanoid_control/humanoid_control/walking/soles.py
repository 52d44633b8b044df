# SPDX-License-Identifier: Apache-2.0
"""Measured poses and loads of the soles."""

from __future__ import annotations

from dataclasses import replace

from humanoid_control.dynamics.rotations import yaw_of
from humanoid_control.walking.foot_shape import FootShape
from humanoid_control.walking.footing import Foothold, Footing
from humanoid_control.walking.gait_context import SoleReading
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.sides import LEFT, RIGHT
from humanoid_control.walking.state_estimator import RobotState
from humanoid_control.walking.terrain import GroundPlane, tilt_of
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def soles_below(
    base_m: Array, robot: WalkingRobot, sensed: RobotState, parameters: WalkParameters
) -> tuple[SoleReading, SoleReading]:
    """
    Compute the poses of both soles, and the loads on them, for a position of the base.

    Parameters
    ----------
    base_m
        Position (3,) of the base in the odom frame.
    robot, sensed
        The robot, and its estimated state.
    parameters : WalkParameters
        Gait parameters, with the maximum tilt of the ground.

    Returns
    -------
    tuple of SoleReading
        Left and right, in the odom frame.

    """
    left, right = (
        _reading(side, base_m, robot, sensed, parameters.terrain.most_tilt_rad)
        for side in (LEFT, RIGHT)
    )
    return left, right


def footing_below(
    start_m: Point,
    robot: WalkingRobot,
    shape: FootShape,
    parameters: WalkParameters,
    sensed: RobotState,
) -> Footing:
    """
    Compute the footholds of both feet for a base above a point of level ground.

    The mean height of the soles is taken as the level of the ground, zero.

    Parameters
    ----------
    start_m
        Point below the base, in the plane of the odom frame.
    robot, shape
        The robot, and the supporting rectangle of its soles.
    parameters : WalkParameters
        Gait parameters, with the maximum tilt of the ground.
    sensed
        Estimated state of the robot.

    Returns
    -------
    Footing
        Footholds of both feet, in the odom frame.

    """
    base_m = np.array([start_m.real, start_m.imag, 0.0])
    soles = soles_below(base_m, robot, sensed, parameters)
    middle_m = sum(sole.plane.height_m for sole in soles) / len(soles)
    return Footing(
        shape,
        [
            Foothold(sole.pose, replace(sole.plane, height_m=sole.plane.height_m - middle_m))
            for sole in soles
        ],
    )


def _reading(
    side: int, base_m: Array, robot: WalkingRobot, sensed: RobotState, most_tilt_rad: float
) -> SoleReading:
    """Compute the pose and the load of one sole."""
    sole = robot.legs[side].sole
    x, y, z = (base_m + sensed.state.position_m(sole)).tolist()
    rotation = sensed.state.rotation(sole)
    plane = GroundPlane(z, tilt_of(rotation, most_tilt_rad))
    pose = PlanarPose(complex(x, y), yaw_of(rotation))
    return SoleReading(pose, plane, sensed.loads[side], sensed.drags[side])
