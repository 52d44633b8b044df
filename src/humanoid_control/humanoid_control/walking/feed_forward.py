# SPDX-License-Identifier: Apache-2.0
"""The part of the ground in the efforts of the joints."""

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
    Return the efforts (n,) that the ground has on the joints through the feet.

    :param base_m: the origin of the base (3,) in the frame of the load points
    :param loads: how the feet share what the ground does
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
