# SPDX-License-Identifier: Apache-2.0
"""Where the base is since the walk began, and how sure that is."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.rotations import wrap_angle
from humanoid_control.walking.planar import PlanarPose
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# What the legs' odometry errs by, as measured in simulation: a share of the way, squared.
_POSITION_GROWTH_M = 0.0025
_HEADING_GROWTH_RAD2_M = 1e-4
_HEADING_GROWTH_RAD = 1e-4
_SMALLEST_VARIANCE = 1e-6


@dataclass(frozen=True, eq=False)
class Odometry:
    """
    Where the base is, by the legs and the inertial sensor.

    The frame has its origin on the ground where the base was first, and x where it faced.
    """

    pose: PlanarPose
    height_m: float
    orientation: tuple[float, float, float, float]
    """Of the base, w, x, y, z."""
    linear_velocity_m_s: Array
    """(3,) in the axes of the base."""
    angular_velocity_rad_s: Array
    """(3,) in the axes of the base."""
    position_variance_m2: float
    """Of x and of y; it grows with the way."""
    heading_variance_rad2: float


class Uncertainty:
    """Grows with the way and the turns of the base."""

    def __init__(self) -> None:
        """Begin sure."""
        self._last: PlanarPose | None = None
        self.position_variance_m2 = _SMALLEST_VARIANCE
        self.heading_variance_rad2 = _SMALLEST_VARIANCE

    def update(self, pose: PlanarPose) -> None:
        """Take where the base is now."""
        if self._last is not None:
            way_m = abs(pose.position_m - self._last.position_m)
            turn_rad = abs(wrap_angle(pose.yaw_rad - self._last.yaw_rad))
            self.position_variance_m2 += _POSITION_GROWTH_M * way_m
            self.heading_variance_rad2 += _HEADING_GROWTH_RAD2_M * way_m
            self.heading_variance_rad2 += _HEADING_GROWTH_RAD * turn_rad
        self._last = pose
