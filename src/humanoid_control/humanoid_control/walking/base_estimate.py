# SPDX-License-Identifier: Apache-2.0
"""Where the base is: leg odometry."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.walking.base_motion import BaseMotion
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.planar import limited
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SURE_LOAD = 0.2
"""A foot that carries this share of the weight surely stands."""
_LEAST_TRUST = 0.02
"""With less than this the robot is in the air, or falls: then the command has to do."""


@dataclass(frozen=True, eq=False)
class BaseEstimate:
    """The origin of the base in the odometry's frame."""

    position_m: Array
    """(3,)"""
    velocity_m_s: Array
    """(3,)"""

    def motion(self, state: BodyState) -> BaseMotion:
        """Return how the base moves, with its turning."""
        return BaseMotion(
            Frame(self.position_m, state.base_rotation),
            Twist(self.velocity_m_s, state.base_angular_velocity_rad_s),
        )

    def com_motion(self, state: BodyState) -> Motion:
        """Return the motion of the centre of mass over the ground."""
        position = self.position_m + state.com_m
        velocity = self.velocity_m_s + state.com_velocity_m_s
        return Motion(complex(position[0], position[1]), complex(velocity[0], velocity[1]))


def carrying(shares: tuple[float, float], loads: tuple[float, float]) -> tuple[float, float]:
    """
    Return how much each foot says of where the base is; the parts sum up to 1.

    A foot that is told to carry weight but does not need not be where it is told to stand.

    :param shares: of the feet in the weight, as commanded
    :param loads: the weight on the soles as measured, as shares of the robot's
    """
    left, right = (
        share * limited(load / _SURE_LOAD, 0.0, 1.0) for share, load in zip(shares, loads)
    )
    total = left + right
    return (left / total, right / total) if total > _LEAST_TRUST else shares


def base_on(
    footing: Footing, shares: tuple[float, float], robot: WalkingRobot, state: BodyState
) -> BaseEstimate:
    """
    Return where the base is if the feet that carry weight stand still where they landed.

    :param shares: of the feet in the weight; they sum up to 1
    """
    position, velocity = np.zeros(3), np.zeros(3)
    for side in SIDES:
        if shares[side] > 0.0:
            sole = robot.legs[side].sole
            position += shares[side] * (footing[side].sole_m - state.position_m(sole))
            velocity -= shares[side] * state.velocity_m_s(sole)
    return BaseEstimate(position, velocity)
