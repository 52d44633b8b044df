# SPDX-License-Identifier: Apache-2.0
"""Detect whether a robot has fallen, from the true pose of its base."""

from __future__ import annotations

import math

LOWEST_SHARE = 0.6
"""The robot has fallen if its base is below this fraction of its first height."""
STEEPEST_RAD = 0.8
"""The robot has fallen if its base tilts by more than this."""


class FallWatch:
    """Fall detector that compares the base with its first height, which counts as standing."""

    def __init__(self) -> None:
        self._height_m: float | None = None

    def stands(self, height_m: float, tilt_rad: float) -> bool:
        """
        Check whether the robot stands; the first call sets the height of standing.

        Parameters
        ----------
        height_m
            Height of the base, in the world frame.
        tilt_rad
            Angle between z of the base and the vertical.

        """
        if self._height_m is None:
            self._height_m = height_m
        return height_m > LOWEST_SHARE * self._height_m and tilt_rad < STEEPEST_RAD


def tilt_rad(x: float, y: float, z: float, w: float) -> float:
    """
    Compute the angle between z of a frame and the vertical.

    Parameters
    ----------
    x, y, z, w
        Quaternion of the frame in the world, of any length.

    Returns
    -------
    float
        Angle in rad from 0 to pi; infinite if the quaternion is zero.

    """
    norm = x * x + y * y + z * z + w * w
    if not norm > 0.0:
        return math.inf
    return math.acos(max(-1.0, 1.0 - 2.0 * (x * x + y * y) / norm))
