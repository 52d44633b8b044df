# SPDX-License-Identifier: Apache-2.0
"""Where the base is: leg odometry."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.rotations import yaw_of
from humanoid_control.walking.footing import Footing
from humanoid_control.walking.gear import SoleReading
from humanoid_control.walking.pendulum import Motion
from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.terrain import Facet, tilt_of
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BaseEstimate:
    """The origin of the base in the odometry's frame."""

    position_m: Array
    """(3,)"""
    velocity_m_s: Array
    """(3,)"""

    def com_motion(self, state: BodyState) -> Motion:
        """Return the motion of the centre of mass over the ground."""
        position = self.position_m + state.com_m
        velocity = self.velocity_m_s + state.com_velocity_m_s
        return Motion(complex(position[0], position[1]), complex(velocity[0], velocity[1]))


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


def sole_reading(
    sole: str, base_m: Array, state: BodyState, load: float, most_tilt_rad: float
) -> SoleReading:
    """Return where a sole is measured, with a load as a share of the weight."""
    x, y, z = (base_m + state.position_m(sole)).tolist()
    rotation = state.rotation(sole)
    facet = Facet(z, tilt_of(rotation, most_tilt_rad))
    return SoleReading(PlanarPose(complex(x, y), yaw_of(rotation)), facet, load)
