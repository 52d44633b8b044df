# SPDX-License-Identifier: Apache-2.0
"""How the robot drives to a dock and back: a velocity from the pose of the target."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_graceful_controller.smooth_control_law import SmoothControlLaw
from nav2_util.geometry import Pose2D, wrap_angle
from nav2_util.parameters import parameter
from nav2_util.twist import Velocity

__all__ = ['STRAIGHT_M', 'ApproachParameters', 'approach_velocity', 'turn_velocity']

STRAIGHT_M = 0.1
"""The distance from the target within which the robot drives straight on."""

_TURN_GAIN = 1.5


@dataclass(frozen=True)
class ApproachParameters:
    """The parameters below `controller` of the docking server."""

    k_phi: float = parameter(
        3.0, 'How fast the heading converges to the line of the dock.', low=0.0
    )
    k_delta: float = parameter(2.0, 'How fast the heading error converges to zero.', low=0.0)
    beta: float = parameter(0.4, 'How much the speed falls with the curvature.', low=0.0)
    lambda_: float = parameter(2.0, 'The power of the curvature in that.', low=0.0, name='lambda')
    v_linear_min: float = parameter(0.1, 'The lowest speed in m/s.', low=0.001)
    v_linear_max: float = parameter(0.24, 'The highest speed in m/s.', low=0.001)
    v_angular_max: float = parameter(0.75, 'The highest angular velocity in rad/s.', low=0.001)
    slowdown_radius: float = parameter(
        0.25, 'The distance in m from the target where the robot slows down.', low=0.0
    )
    use_collision_detection: bool = parameter(True, 'Whether to stop before collisions.')
    costmap_topic: str = parameter(
        'local_costmap/costmap_raw', 'The topic of the costmap for that.', read_only=True
    )
    footprint_topic: str = parameter(
        'local_costmap/published_footprint', 'The topic of the footprint.', read_only=True
    )
    transform_tolerance: float = parameter(
        0.1, 'How much older than 1 s the pose of the robot may be, in s.', low=0.0
    )
    projection_time: float = parameter(
        1.0, 'How far ahead in s collisions are looked for.', low=0.0
    )
    simulation_time_step: float = parameter(
        0.1, 'The time between two poses that are checked, in s.', low=0.001
    )
    dock_collision_threshold: float = parameter(
        0.3, 'The distance in m from the dock within which collisions do not count.', low=0.0
    )


def approach_velocity(
    target: Pose2D, values: ApproachParameters, *, backward: bool = False
) -> Velocity:
    """
    Compute the velocity that leads to a target pose, and on in its direction.

    The control law of the graceful controller turns at any rate very near to the target. There
    the robot drives straight on instead, aligned to it, so that it also touches a dock whose
    contact ends the approach.

    Parameters
    ----------
    target
        The target pose in the base frame.
    values
        Gains and limits.
    backward
        Whether to drive there backward.

    """
    distance_m = math.hypot(target.x, target.y)
    share = min(1.0, distance_m / values.slowdown_radius) if values.slowdown_radius else 1.0
    speed = max(values.v_linear_min, share * values.v_linear_max)
    if distance_m < STRAIGHT_M:
        rate = turn_velocity(target.yaw, values).yaw
        return Velocity(-speed if backward else speed, 0.0, rate)
    law = SmoothControlLaw(
        values.k_phi,
        values.k_delta,
        values.beta,
        values.lambda_,
        min(values.v_linear_min, speed),
        speed,
        values.v_angular_max,
    )
    x, yaw = law.velocity(target, backward=backward)
    return Velocity(x, 0.0, yaw)


def turn_velocity(angle_rad: float, values: ApproachParameters) -> Velocity:
    """
    Compute the velocity that turns the robot on the spot.

    Parameters
    ----------
    angle_rad
        The angle to turn by.
    values
        The limits.

    """
    rate = _TURN_GAIN * wrap_angle(angle_rad)
    return Velocity(0.0, 0.0, min(max(rate, -values.v_angular_max), values.v_angular_max))
