# SPDX-License-Identifier: Apache-2.0
"""Orientation of the base in the odom frame, from the IMU."""

from __future__ import annotations

from collections.abc import Sequence
import math

from humanoid_control.dynamics.rotations import about_z, from_quaternion, log, yaw_of
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class HeadingFrame:
    """
    Heading of the odom frame, whose x axis is the first heading of the base.

    Parameters
    ----------
    imu_in_base
        Rotation matrix (3, 3) from imu_link to base_link.

    """

    def __init__(self, imu_in_base: Array) -> None:
        self._base_in_imu: Array = imu_in_base.T
        self._offset_rad: float | None = None
        self._turn: Array = np.eye(3)

    def base_rotation(self, orientation: Sequence[float] | Array) -> Array:
        """
        Compute the rotation of the base from the orientation that the IMU measures.

        The first call sets the zero of the heading: later ones are relative to it.

        Parameters
        ----------
        orientation
            Orientation of the IMU in the world: a quaternion w, x, y, z of any norm.

        Returns
        -------
        Array
            Rotation matrix (3, 3) from base_link to the odom frame.

        Raises
        ------
        ValueError
            The quaternion is zero or not finite, or it does not have four components.

        """
        rotation: Array = from_quaternion(orientation) @ self._base_in_imu
        if self._offset_rad is None:
            self._offset_rad = yaw_of(rotation)
            self._turn = about_z(-self._offset_rad)
        turned: Array = self._turn @ rotation
        return turned

    def base_rates(self, angular_velocity_rad_s: Array) -> Array:
        """
        Rotate an angular velocity from the axes of the IMU into those of the base.

        Parameters
        ----------
        angular_velocity_rad_s
            As the gyroscope measures it (3,), in the axes of imu_link.

        Returns
        -------
        Array
            Angular velocity (3,) in rad/s, in the axes of base_link.

        """
        rates: Array = self._base_in_imu.T @ angular_velocity_rad_s
        return rates


def quaternion_of(rotation: Array) -> tuple[float, float, float, float]:
    """
    Convert a rotation matrix to a unit quaternion.

    Parameters
    ----------
    rotation
        The rotation matrix (3, 3).

    Returns
    -------
    tuple of float
        The quaternion w, x, y, z, with w not negative.

    """
    turn = log(rotation)
    half_rad = math.sqrt(turn @ turn) / 2.0
    x, y, z = (turn * (float(np.sinc(half_rad / math.pi)) / 2.0)).tolist()
    return math.cos(half_rad), x, y, z
