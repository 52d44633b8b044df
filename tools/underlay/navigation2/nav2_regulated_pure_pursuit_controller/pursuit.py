# SPDX-License-Identifier: Apache-2.0
"""
Regulated pure pursuit: the point that the robot aims at, and how fast it goes there.

Source: S. Macenski, S. Singh, F. Martin, J. Gines, Regulated Pure Pursuit for Robot Path Tracking,
Autonomous Robots 47 (2023).
"""

from __future__ import annotations

import math

from nav2_costmap_2d.costs import FREE_SPACE, INSCRIBED_INFLATED_OBSTACLE, NO_INFORMATION
from nav2_regulated_pure_pursuit_controller.parameters import RppParameters
import numpy as np
import numpy.typing as npt

__all__ = [
    'approach_speed',
    'cost_speed',
    'curvature_speed',
    'cusp_distance',
    'lookahead_point',
    'regulated_speed',
]

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


def curvature_speed(speed: float, curvature: float, min_radius_m: float) -> float:
    """
    Limit the speed in a curve.

    Parameters
    ----------
    speed
        The unregulated speed in m/s.
    curvature
        The curvature of the arc in 1/m; its sign is ignored.
    min_radius_m
        The radius in m below which the speed is scaled in proportion to the radius.

    Returns
    -------
    float
        The speed in m/s.

    """
    radius = 1.0 / abs(curvature) if curvature else math.inf
    return speed * radius / min_radius_m if radius < min_radius_m else speed


def cost_speed(
    speed: float, cost: int, inscribed_radius_m: float, settings: RppParameters
) -> float:
    """
    Limit the speed in m/s near obstacles.

    Parameters
    ----------
    speed
        The unregulated speed.
    cost
        The cost at the robot's position, from which the distance to obstacles is derived.
    inscribed_radius_m
        The radius of the robot in the inflation of the costmap.
    settings
        The parameters of the scaling.

    """
    factor = settings.inflation_cost_scaling_factor
    if cost in (FREE_SPACE, NO_INFORMATION) or factor <= 0.0:
        return speed
    distance = inscribed_radius_m
    if cost < INSCRIBED_INFLATED_OBSTACLE:
        distance += math.log((INSCRIBED_INFLATED_OBSTACLE - 1) / cost) / factor
    if distance >= settings.cost_scaling_dist:
        return speed
    return min(speed * settings.cost_scaling_gain * distance / settings.cost_scaling_dist, speed)


def approach_speed(speed: float, remaining_m: float, settings: RppParameters) -> float:
    """
    Limit the speed when approaching the goal.

    Parameters
    ----------
    speed
        The unregulated speed in m/s.
    remaining_m
        The remaining length of the path in m.
    settings
        The distance at which the robot starts to slow down, and its minimum speed.

    Returns
    -------
    float
        The speed in m/s: in proportion to the remaining length, but at least the minimum.

    """
    distance = settings.approach_velocity_scaling_dist
    if remaining_m >= distance:
        return speed
    return min(speed, max(speed * remaining_m / distance, settings.min_approach_linear_velocity))


def regulated_speed(
    fastest: float,
    curvature: float,
    cost: int,
    inscribed_radius_m: float,
    remaining_m: float,
    settings: RppParameters,
) -> float:
    """
    Compute the speed in m/s allowed by curves, obstacles and the goal.

    Parameters
    ----------
    fastest
        The unregulated speed.
    curvature
        The curvature of the arc in 1/m.
    cost, inscribed_radius_m
        See `cost_speed`.
    remaining_m
        The remaining length of the path.
    settings
        The parameters of the regulation.

    """
    speed = fastest
    if settings.use_regulated_linear_velocity_scaling:
        radius = settings.regulated_linear_scaling_min_radius
        speed = min(speed, curvature_speed(fastest, curvature, radius))
    if settings.use_cost_regulated_linear_velocity_scaling:
        speed = min(speed, cost_speed(fastest, cost, inscribed_radius_m, settings))
    speed = max(speed, min(settings.regulated_linear_scaling_min_speed, fastest))
    return approach_speed(speed, remaining_m, settings)
