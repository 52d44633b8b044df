# SPDX-License-Identifier: Apache-2.0
"""Predict the time to collision at constant velocity."""

from __future__ import annotations

import math

from nav2_collision_monitor.shapes import FloatArray, Shape
from nav2_util.twist import Velocity
import numpy as np

__all__ = ['collision_time']

_BATCH = 200_000
_MOST_STEPS = 10_000


def collision_time(
    points: FloatArray,
    shape: Shape,
    velocity: Velocity,
    *,
    min_points: int,
    horizon_s: float,
    step_s: float,
) -> float | None:
    """
    Compute when at least `min_points` are inside a shape that moves with the robot.

    Parameters
    ----------
    points
        (N, 2) obstacles in m in the base frame.
    shape
        The outline of the robot.
    velocity
        The velocity of the robot, assumed constant.
    min_points
        Fewer points are ignored as noise.
    horizon_s, step_s
        The prediction horizon and the time step.

    Returns
    -------
    float or None
        The time in s, 0 if they are already inside; None if not within the horizon.

    """
    step_s = max(step_s, horizon_s / _MOST_STEPS, 1e-6)
    times = np.arange(math.floor(horizon_s / step_s + 1e-9) + 1, dtype=np.float64) * step_s
    distances = np.hypot(points[:, 0], points[:, 1])
    points = points[distances <= shape.reach_m + velocity.linear * horizon_s]
    if len(points) < min_points:
        return None
    poses = velocity.poses_after(times)
    batch = max(_BATCH // len(points), 1)
    for start in range(0, len(poses), batch):
        x, y, yaw = poses[slice(start, start + batch)].T[:, :, np.newaxis]
        dx, dy = points[:, 0] - x, points[:, 1] - y
        cos, sin = np.cos(yaw), np.sin(yaw)
        seen = np.stack([cos * dx + sin * dy, cos * dy - sin * dx], axis=-1)
        hits = np.flatnonzero(shape.contains(seen).sum(axis=1) >= min_points)
        if hits.size:
            return float(times[start + hits[0]])
    return None
