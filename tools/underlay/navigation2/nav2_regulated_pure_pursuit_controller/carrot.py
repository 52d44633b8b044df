# SPDX-License-Identifier: Apache-2.0
"""The lookahead point on the path, and the cusps of the path."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

__all__ = ['cusp_distance', 'lookahead_point']

FloatArray = npt.NDArray[np.float64]


def lookahead_point(
    plan: FloatArray,
    distance_m: float,
    *,
    interpolate: bool = True,
    beyond_end: bool = False,
) -> tuple[float, float]:
    """
    Find the point of a path at a distance from the robot.

    Parameters
    ----------
    plan
        (N, 2 or more) positions in the base frame, from the nearest one on.
    distance_m
        The lookahead distance from the robot.
    interpolate
        Whether to interpolate between two poses; otherwise it is the first one beyond.
    beyond_end
        Whether to extrapolate straight beyond the end of the path; otherwise it is the end.

    """
    distances = np.hypot(plan[:, 0], plan[:, 1])
    beyond = distances >= distance_m
    index = int(np.argmax(beyond))
    if not beyond[index]:
        end = plan[-1, :2]
        if beyond_end and len(plan) > 1:
            start = plan[max(len(plan) - 4, 0), :2]
            step = end - start
            length = float(np.hypot(*step))
            if length > 1e-6:
                step = step / length
                return _on_circle(end, end + step * 2.0 * distance_m, distance_m)
        return float(end[0]), float(end[1])
    if interpolate and index > 0:
        return _on_circle(plan[index - 1, :2], plan[index, :2], distance_m)
    return float(plan[index, 0]), float(plan[index, 1])


def _on_circle(inner: FloatArray, outer: FloatArray, radius: float) -> tuple[float, float]:
    """Compute the exit point from a circle around the origin of a line from inside to outside."""
    step = outer - inner
    a = float(step @ step)
    b, c = float(inner @ step), float(inner @ inner) - radius * radius
    along = (-b + math.sqrt(max(b * b - a * c, 0.0))) / a if a > 0.0 else 0.0
    along = min(max(along, 0.0), 1.0)
    return float(inner[0] + along * step[0]), float(inner[1] + along * step[1])


def cusp_distance(plan: FloatArray) -> float:
    """
    Compute the distance from the robot to the first cusp of the path in m.

    Parameters
    ----------
    plan
        (N, 2 or more) positions in the base frame.

    Returns
    -------
    The distance; infinite if the path has no cusp.

    """
    steps = np.diff(plan[:, :2], axis=0)
    turns = (steps[:-1] * steps[1:]).sum(axis=1) < 0.0
    if not turns.any():
        return math.inf
    x, y = plan[int(np.argmax(turns)) + 1, :2]
    return math.hypot(x, y)
