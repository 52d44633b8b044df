# SPDX-License-Identifier: Apache-2.0
"""The parameters of regulated pure pursuit."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_util.parameters import parameter, Unsupported

__all__ = ['UNSUPPORTED', 'RppParameters']

UNSUPPORTED: dict[str, str | Unsupported] = {
    'min_distance_to_obstacle': (
        'collisions are checked as far ahead as max_allowed_time_to_collision_up_to_carrot says'
    ),
    'use_path_aware_obstacle_distance': "the cost at the robot's place counts",
    'stateful': Unsupported(
        'as always, the position once reached counts while the robot turns to the goal', (True,)
    ),
    'goal_dist_tol': 'the tolerance is that of the goal checker',
    'max_linear_accel': 'accelerations are limited by the velocity smoother',
    'max_linear_decel': 'accelerations are limited by the velocity smoother',
}


@dataclass(frozen=True)
class RppParameters:
    """The parameters of regulated pure pursuit."""

    desired_linear_vel: float = parameter(0.5, 'The highest speed in m/s.', low=0.0)
    lookahead_dist: float = parameter(
        0.6, 'The distance in m of the point to steer to, if it is not scaled.', low=0.0
    )
    min_lookahead_dist: float = parameter(0.3, 'Its lowest value in m if scaled.', low=0.0)
    max_lookahead_dist: float = parameter(0.9, 'Its highest value in m if scaled.', low=0.0)
    lookahead_time: float = parameter(
        1.5, 'The speed is multiplied by this in s for a scaled distance.', low=0.0
    )
    use_velocity_scaled_lookahead_dist: bool = parameter(
        False, 'Whether the distance to the point to steer to grows with the speed.'
    )
    rotate_to_heading_angular_vel: float = parameter(
        1.8, 'The angular velocity in rad/s for turning in place.', low=0.0
    )
    min_approach_linear_velocity: float = parameter(
        0.05, 'The lowest speed in m/s near the goal.', low=0.0
    )
    approach_velocity_scaling_dist: float = parameter(
        0.6, 'The length of path in m before the goal where the robot slows down.', low=0.0
    )
    use_collision_detection: bool = parameter(True, 'Whether to stop before collisions.')
    max_allowed_time_to_collision_up_to_carrot: float = parameter(
        1.0, 'How far ahead in s collisions are looked for.', low=0.0
    )
    use_regulated_linear_velocity_scaling: bool = parameter(
        True, 'Whether to slow down in curves.'
    )
    use_cost_regulated_linear_velocity_scaling: bool = parameter(
        True, 'Whether to slow down near obstacles.'
    )
    cost_scaling_dist: float = parameter(
        0.6, 'The distance in m of obstacles from which on to slow down.', low=0.0
    )
    cost_scaling_gain: float = parameter(
        1.0, 'How much: the speed is multiplied by this and the distance over it.', low=0.0
    )
    inflation_cost_scaling_factor: float = parameter(
        3.0, 'The cost_scaling_factor of the inflation layer of the local costmap.', low=0.0
    )
    regulated_linear_scaling_min_radius: float = parameter(
        0.90, 'The radius of curves in m below which to slow down.', low=0.0
    )
    regulated_linear_scaling_min_speed: float = parameter(
        0.25, 'The speed in m/s below which curves and obstacles do not slow down.', low=0.0
    )
    use_fixed_curvature_lookahead: bool = parameter(
        False, 'Whether the curvature is that of a point at a fixed distance.'
    )
    curvature_lookahead_dist: float = parameter(0.6, 'The distance in m of that point.', low=0.0)
    use_rotate_to_heading: bool = parameter(
        True, 'Whether to turn in place to the path, and at the goal.'
    )
    rotate_to_heading_min_angle: float = parameter(
        0.785, 'The angle in rad to the path above which to turn in place.', low=0.0
    )
    max_angular_accel: float = parameter(
        3.2, 'The angular acceleration in rad/s^2 when turning in place.', low=0.0
    )
    use_cancel_deceleration: bool = parameter(
        False, 'Whether to slow down gradually after the goal was canceled.'
    )
    cancel_deceleration: float = parameter(3.2, 'The deceleration in m/s^2 after that.', low=0.0)
    allow_reversing: bool = parameter(
        False, 'Whether to drive backward where the path leads backward.'
    )
    interpolate_curvature_after_goal: bool = parameter(
        False, 'Whether to steer to a point beyond the goal, straight on, near the end.'
    )
    use_interpolation: bool = parameter(
        True, 'Whether the point to steer to may be between two poses of the path.'
    )
