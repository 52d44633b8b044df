# SPDX-License-Identifier: Apache-2.0
"""Simulated laser scanner of the loopback simulator."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_amcl.occupancy_map import FloatArray, OccupancyMap
from nav2_amcl.ray_casting import RayCaster
from nav2_util.geometry import Pose2D
import numpy as np

__all__ = ['LaserShape', 'SimulatedLaser']

_BELOW_MAXIMUM_M = 0.1


@dataclass(frozen=True)
class LaserShape:
    """Beam angles of a scanner in rad, and its range limits in m."""

    angle_min_rad: float
    angle_max_rad: float
    angle_increment_rad: float
    range_min_m: float
    range_max_m: float
    uses_inf: bool = True

    @property
    def count(self) -> int:
        """The number of beams."""
        span = self.angle_max_rad - self.angle_min_rad
        return max(int(span / self.angle_increment_rad + 1e-6) + 1, 1)


class SimulatedLaser:
    """
    Noiseless laser scanner that detects the occupied cells of a map, once there is one.

    Parameters
    ----------
    shape
        The beams.

    """

    def __init__(self, shape: LaserShape) -> None:
        self.shape = shape
        steps = np.arange(shape.count, dtype=np.float64)
        self._angles: FloatArray = shape.angle_min_rad + steps * shape.angle_increment_rad
        self._caster: RayCaster | None = None

    @property
    def has_map(self) -> bool:
        """Whether a map is set."""
        return self._caster is not None

    def set_map(self, grid: OccupancyMap) -> None:
        """
        Set the map whose occupied cells the beams hit.

        Parameters
        ----------
        grid
            The map; its frame is that of the poses given to `scan`.

        """
        self._caster = RayCaster(grid)

    def scan(self, pose: Pose2D | None) -> FloatArray:
        """
        Compute the ranges of a scan.

        Parameters
        ----------
        pose
            The pose of the laser in the map; None if unknown.

        Returns
        -------
        (B,) array of ranges in m, at least the minimum; without a hit, inf or 0.1 m below the
        maximum.

        """
        if self._caster is None or pose is None:
            ranges = np.full(len(self._angles), np.inf)
        else:
            origin = np.array([[pose.x, pose.y]])
            ranges = self._caster.cast(origin, pose.yaw + self._angles, self.shape.range_max_m)
        seen = np.maximum(ranges, self.shape.range_min_m)
        nothing = np.inf if self.shape.uses_inf else self.shape.range_max_m - _BELOW_MAXIMUM_M
        return np.where(np.isfinite(ranges), seen, nothing)
