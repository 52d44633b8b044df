# SPDX-License-Identifier: Apache-2.0
"""
Speed regulation in curves, near obstacles and at the goal.

Source: S. Macenski, S. Singh, F. Martin, J. Gines, Regulated Pure Pursuit for Robot Path Tracking,
Autonomous Robots 47 (2023).
"""

from __future__ import annotations

import math

from nav2_costmap_2d.costs import FREE_SPACE, INSCRIBED_INFLATED_OBSTACLE, NO_INFORMATION
from nav2_regulated_pure_pursuit_controller.parameters import RppParameters

__all__ = ['approach_speed', 'cost_speed', 'curvature_speed', 'regulated_speed']


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
