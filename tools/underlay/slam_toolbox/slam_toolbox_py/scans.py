# SPDX-License-Identifier: Apache-2.0
"""Scans of a planar laser scanner: points, surface normals and free space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree
from slam_toolbox_py.poses import FloatArray

__all__ = ['Scan', 'surface_normals', 'take_scan']

_NEIGHBOURS = 12
_NEIGHBOURHOOD_M = 0.25
_FLATNESS = 0.1


@dataclass(frozen=True)
class Scan:
    """A sweep in the planar base frame: x forward, y left, z up, independent of the tilt."""

    points: FloatArray
    """(N, 2) end points of the beams that hit something, in m."""
    normals: FloatArray
    """(N, 2) unit surface normals at the points, towards the scanner; 0 where unknown."""
    outline: FloatArray
    """(B, 2) corners of the area that the beams have swept, in m."""
    origin: FloatArray
    """(2,) position of the scanner, in m."""

    @property
    def barycenter(self) -> FloatArray:
        """The mean of the points, (2,), in m; the scanner's position if there are none."""
        return self.points.mean(axis=0) if len(self.points) else self.origin


def take_scan(
    ranges: FloatArray,
    angles: FloatArray,
    turn: FloatArray,
    origin: FloatArray,
    range_min_m: float,
    range_max_m: float,
) -> Scan:
    """
    Project a sweep to the ground.

    Parameters
    ----------
    ranges, angles
        (B,) distances in m, and directions in rad in the plane x, y of the scanner. Distances
        that are NaN, infinite or below the minimum are ignored.
    turn, origin
        (3, 3) rotation matrix and (3,) position in m of the scanner in the planar base frame.
    range_min_m, range_max_m
        The valid ranges; a longer beam sweeps free space up to the maximum.

    """
    ranges = np.asarray(ranges, dtype=float)
    is_measured = np.isfinite(ranges) & (ranges >= range_min_m)
    is_hit = is_measured & (ranges <= range_max_m)
    reach = np.where(is_measured, np.minimum(np.nan_to_num(ranges, posinf=0.0), range_max_m), 0.0)
    beams = np.stack([np.cos(angles), np.sin(angles)], axis=1) @ turn[:2, :2].T
    outline = origin[:2] + reach[:, None] * beams
    points = outline[is_hit]
    return Scan(points, surface_normals(points, origin[:2]), outline, np.array(origin[:2]))


def surface_normals(points: FloatArray, origin: FloatArray) -> FloatArray:
    """
    Estimate the surface normals at points by principal component analysis.

    Parameters
    ----------
    points
        (N, 2) array in m.
    origin
        (2,) position towards which the normals point.

    Returns
    -------
    (N, 2) unit vectors; 0 where the neighbours are too few or not on a line.

    """
    if len(points) < 3:
        return np.zeros((len(points), 2))
    near = cKDTree(points).query(points, _NEIGHBOURS, distance_upper_bound=_NEIGHBOURHOOD_M)[1]
    is_near = near < len(points)
    offsets = points[np.where(is_near, near, 0)] - points[:, None]
    offsets *= is_near[..., None]
    count = is_near.sum(axis=1)
    offsets -= (offsets.sum(axis=1) / count[:, None])[:, None] * is_near[..., None]
    xx, yy = (offsets**2).sum(axis=1).T
    xy = (offsets[..., 0] * offsets[..., 1]).sum(axis=1)
    direction = 0.5 * np.arctan2(2.0 * xy, xx - yy)
    spread = np.hypot(xx - yy, 2.0 * xy)
    normals = np.stack([-np.sin(direction), np.cos(direction)], axis=1)
    is_away = ((origin - points) * normals).sum(axis=1) < 0.0
    normals[is_away] *= -1.0
    is_flat = (count >= 3) & (xx + yy - spread < _FLATNESS * (xx + yy + spread))
    found: FloatArray = normals * is_flat[:, None]
    return found
