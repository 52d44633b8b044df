# SPDX-License-Identifier: Apache-2.0
"""Project a scan into the plane of the map, whatever the tilt of the laser."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_amcl.occupancy_map import FloatArray
import numpy as np
import numpy.typing as npt

__all__ = ['Beams', 'Scan', 'project_scan']


@dataclass(frozen=True)
class Scan:
    """The readings of a laser scanner; range i is at `angle_min + i * angle_increment`."""

    ranges_m: FloatArray
    angle_min_rad: float
    angle_increment_rad: float
    range_min_m: float
    range_max_m: float


@dataclass(frozen=True)
class Beams:
    """
    The beams of a scan that are used, projected into the plane of the robot's base.

    `origin` is x and y of the laser in m, `angles` (B,) the directions in rad, `ranges` (B,) the
    lengths in m; those at which nothing was hit have `max_range_m` and `hits` False.
    """

    origin: tuple[float, float]
    angles: FloatArray
    ranges: FloatArray
    hits: npt.NDArray[np.bool_]
    max_range_m: float

    def points(self) -> FloatArray:
        """Compute the (H, 2) hit points in m."""
        angles, ranges = self.angles[self.hits], self.ranges[self.hits]
        directions = np.stack((np.cos(angles), np.sin(angles)), axis=-1)
        points: FloatArray = np.array(self.origin) + ranges[:, None] * directions
        return points


def project_scan(
    scan: Scan,
    rotation: FloatArray,
    translation: FloatArray,
    max_beams: int,
    min_range_m: float = -1.0,
    max_range_m: float = -1.0,
) -> Beams:
    """
    Choose beams evenly from a scan, and project them into the plane of the base.

    Readings that are NaN or below the minimum are dropped; those at or beyond the maximum, and
    infinite ones, are beams without a hit.

    Parameters
    ----------
    scan
        The readings.
    rotation, translation
        (3, 3) matrix and (3,) vector in m of the laser in a frame at the base with its heading
        whose z axis points upwards.
    max_beams
        The maximum number of beams.
    min_range_m, max_range_m
        The range limits; negative values stand for the limits of the scanner itself.

    Returns
    -------
    The beams, perhaps none.

    """
    low = scan.range_min_m if min_range_m < 0.0 else max(min_range_m, scan.range_min_m)
    high = scan.range_max_m if max_range_m < 0.0 else min(max_range_m, scan.range_max_m)
    ranges = np.asarray(scan.ranges_m, float)
    usable = np.flatnonzero(ranges >= low)  # False for NaN
    if len(usable) > max_beams:
        usable = usable[np.linspace(0, len(usable) - 1, max_beams).round().astype(int)]
    ranges = ranges[usable]
    angles = scan.angle_min_rad + usable * scan.angle_increment_rad
    hits = ranges < high
    lengths = np.where(hits, ranges, high)
    directions = np.cos(angles)[:, None] * rotation[:2, 0]
    directions += np.sin(angles)[:, None] * rotation[:2, 1]
    flat = np.hypot(directions[:, 0], directions[:, 1])
    return Beams(
        origin=(float(translation[0]), float(translation[1])),
        angles=np.arctan2(directions[:, 1], directions[:, 0]),
        ranges=lengths * flat,
        hits=hits & (flat > math.cos(math.radians(60.0))),
        max_range_m=float(high),
    )
