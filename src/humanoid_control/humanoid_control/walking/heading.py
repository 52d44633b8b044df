# SPDX-License-Identifier: Apache-2.0
"""How the base is turned in the frame of the odometry, from the inertial sensor."""

from __future__ import annotations

from collections.abc import Sequence
import math

from humanoid_control.dynamics.rotations import about_z, from_quaternion, log, yaw_of
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class HeadingFrame:
    """The frame whose x axis points where the base faced first."""

    def __init__(self, imu_in_base: Array) -> None:
        """Take how the sensor sits in the base, (3, 3)."""
        self._base_in_imu: Array = imu_in_base.T
        self._offset_rad: float | None = None
        self._turn: Array = np.eye(3)

    def base_rotation(self, orientation: Sequence[float] | Array) -> Array:
        """Return the rotation (3, 3) of the base for what the sensor says, w, x, y, z."""
        rotation: Array = from_quaternion(orientation) @ self._base_in_imu
        if self._offset_rad is None:
            self._offset_rad = yaw_of(rotation)
            self._turn = about_z(-self._offset_rad)
        turned: Array = self._turn @ rotation
        return turned

    def base_rates(self, angular_velocity_rad_s: Array) -> Array:
        """Return the angular velocity (3,) that the sensor says, in the axes of the base."""
        rates: Array = self._base_in_imu.T @ angular_velocity_rad_s
        return rates


def quaternion_of(rotation: Array) -> tuple[float, float, float, float]:
    """Return a rotation (3, 3) as w, x, y, z."""
    turn = log(rotation)
    half_rad = math.sqrt(turn @ turn) / 2.0
    x, y, z = (turn * (float(np.sinc(half_rad / math.pi)) / 2.0)).tolist()
    return math.cos(half_rad), x, y, z
