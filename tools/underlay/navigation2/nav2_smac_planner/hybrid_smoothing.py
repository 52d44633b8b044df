# SPDX-License-Identifier: Apache-2.0
"""Smooth a path of arcs and straight lines as far as it can still be driven."""

from __future__ import annotations

from collections.abc import Callable

from nav2_constrained_smoother.optimization import minimize, Objective, Termination
from nav2_planner.path_shape import Rounding
from nav2_smoother.path_smoothing import segments
import numpy as np
import numpy.typing as npt

__all__ = ['smoothed_path']

FloatArray = npt.NDArray[np.float64]
_SHORTEST = 6
"""Stretches of fewer poses are left as they are."""
_CURVE = 1.0
"""The weight of curvature beyond the limit, in 1/m: far above that of deviations, in m."""
_ITERATIONS = 20
_SLACK = 1.02
"""How much more a curve may bend than with the turning radius: points are not exactly on it."""


def smoothed_path(
    poses: FloatArray,
    rounding: Rounding,
    radius_m: float,
    is_free: Callable[[FloatArray], bool],
) -> FloatArray:
    """
    Smooth the stretches of a path between its cusps.

    Parameters
    ----------
    poses
        (N, 3) x and y in m, yaw in rad; opposite to the path where the robot drives backward.
    rounding
        The weights, and how often to smooth.
    radius_m
        The turning radius.
    is_free
        Whether the robot collides nowhere at poses (M, 3).

    Returns
    -------
    numpy.ndarray
        (N, 3) poses, the ends and cusps as they were. A stretch that would collide, or bend more
        than the turning radius allows, is as it was.

    """
    result = np.array(poses)
    for begin, end in segments(poses):
        if end - begin < _SHORTEST:
            continue
        stretch = poses[begin:end]
        points = stretch[:, :2]
        for _ in range(rounding.times):
            points = _smoothed(points, rounding, radius_m)
        found = np.column_stack([points, _yaws(points, stretch)])
        allowed = max(_SLACK / radius_m, _most_curved(stretch[:, :2]))
        if _most_curved(points) <= allowed and is_free(found):
            result[begin:end] = found
    return result


def _smoothed(points: FloatArray, rounding: Rounding, radius_m: float) -> FloatArray:
    """Balance changes of direction against the deviation, with the reach of `smoothed`."""
    held = np.zeros(len(points), bool)
    held[[1, -2]] = True  # the directions at the ends
    objective = Objective(
        smooth=rounding.smooth**2,
        curve=_CURVE,
        dist=rounding.data**2,
        cost=np.zeros(len(points)),
        max_curvature=1.0 / radius_m,
    )
    return minimize(points, held, objective, None, Termination(iterations=_ITERATIONS)).points


def _yaws(points: FloatArray, before: FloatArray) -> FloatArray:
    """Compute the yaws along points that were poses; those of the ends stay."""
    along = points[2:] - points[:-2]
    yaws = np.arctan2(along[:, 1], along[:, 0])
    forward = np.cos(yaws - before[1:-1, 2]).sum() >= 0.0
    if not forward:
        yaws = np.arctan2(-along[:, 1], -along[:, 0])
    return np.concatenate([before[:1, 2], yaws, before[-1:, 2]])


def _most_curved(points: FloatArray) -> float:
    """Compute the highest curvature of points, in 1/m: the circle through three of them."""
    before, after = points[1:-1] - points[:-2], points[2:] - points[1:-1]
    across = points[2:] - points[:-2]
    areas = np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    sides = np.hypot(*before.T) * np.hypot(*after.T) * np.hypot(*across.T)
    return float((2.0 * areas / np.maximum(sides, 1e-12)).max(initial=0.0))
