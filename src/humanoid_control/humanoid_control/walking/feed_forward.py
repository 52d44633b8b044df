# SPDX-License-Identifier: Apache-2.0
"""The efforts that carry the robot and swing its leg, before any error shows."""

from __future__ import annotations

from humanoid_control.dynamics import BodyState
from humanoid_control.walking.footing import Loads
from humanoid_control.walking.pendulum import GRAVITY_M_S2
from humanoid_control.walking.planar import Point
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def ground_force(mass_kg: float, com_acceleration_m_s2: Point) -> Array:
    """Return the force (3,) of the ground that carries a mass and accelerates it in the plane."""
    along = com_acceleration_m_s2
    return mass_kg * np.array([along.real, along.imag, GRAVITY_M_S2])


def carrying_efforts(
    robot: WalkingRobot,
    state: BodyState,
    base_m: Array,
    loads: Loads,
    force_n: Array,
) -> Array:
    """
    Return the efforts (n,) with which the feet exert a force on the ground.

    These are the efforts of gravity and motion, less those that the ground's force has through
    the points of load.

    :param base_m: the origin of the base (3,) in the frame of the load points
    :param force_n: of the ground on both feet together, (3,)
    """
    efforts: Array = state.bias_nm.copy()
    for side in SIDES:
        share, point = loads.shares[side], loads.points_m[side]
        if share > 0.0:
            place = np.array([point.real, point.imag, 0.0]) - base_m
            sole = robot.legs[side].sole
            efforts -= share * state.efforts_of_force_nm(sole, place, force_n)
    return efforts


def add_swing_efforts(
    robot: WalkingRobot, state: BodyState, side: int, accelerations_rad_s2: Array, efforts: Array
) -> None:
    """Add what accelerates the leg in the air; all arrays are (n,)."""
    group = robot.legs[side].group
    efforts[group.indices] += state.inertia_kgm2(group) @ accelerations_rad_s2[group.indices]
