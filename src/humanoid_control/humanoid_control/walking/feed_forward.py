# SPDX-License-Identifier: Apache-2.0
"""Feed-forward joint torques of the ground reaction."""

from __future__ import annotations

from humanoid_control.dynamics import BodyState
from humanoid_control.walking.footing import Loads
from humanoid_control.walking.ground_reaction import GroundReaction
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def ground_efforts(
    robot: WalkingRobot, state: BodyState, base_m: Array, loads: Loads, reaction: GroundReaction
) -> Array:
    """
    Map the ground reaction to joint torques with the transposed Jacobians of the feet.

    Parameters
    ----------
    robot, state
        The robot and its measured state.
    base_m
        Origin of base_link (3,): x and y in the odom frame, z above the ground.
    loads
        Load distribution, and the centre of pressure under each foot in the odom frame.
    reaction
        Total force of the ground, and its torque about the vertical.

    Returns
    -------
    Array
        Torques (n,) in N m that the ground exerts on the joints. Subtract them from those of
        inverse dynamics to get what the actuators have to exert.

    """
    efforts: Array = np.zeros(len(robot.body.joints))
    turn = np.array([0.0, 0.0, reaction.turn_nm])
    for side in SIDES:
        share, point = loads.shares[side], loads.points_m[side]
        if share > 0.0:
            place = np.array([point.real, point.imag, 0.0]) - base_m
            sole = robot.legs[side].sole
            efforts += share * state.efforts_of_force_nm(sole, place, reaction.force_n, turn)
    return efforts
