# SPDX-License-Identifier: Apache-2.0
"""The parameters of the graceful controller."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_util.parameters import parameter

__all__ = ['UNSUPPORTED', 'GracefulParameters']

UNSUPPORTED = {
    'motion_target_dist': 'the target is between min_lookahead and max_lookahead',
    'final_rotation': 'set prefer_final_rotation',
    'initial_rotation_min_angle': 'set initial_rotation_tolerance',
    'v_linear_max_initial': 'v_linear_max holds from the start',
    'v_angular_max_initial': 'v_angular_max holds from the start',
}


@dataclass(frozen=True)
class GracefulParameters:
    """The parameters of the graceful controller."""

    min_lookahead: float = parameter(
        0.25, 'The least distance in m of the pose that is the target.', low=0.0
    )
    max_lookahead: float = parameter(
        1.0, 'The largest distance in m of the pose that is the target.', low=0.0
    )
    k_phi: float = parameter(
        2.0, 'How fast the robot turns to the line through the target; k1 of the paper.', low=0.0
    )
    k_delta: float = parameter(
        1.0, 'How fast the error of its heading vanishes; k2 of the paper.', low=0.0
    )
    beta: float = parameter(0.4, 'How much curvature slows down.', low=0.0)
    lambda_: float = parameter(
        2.0, 'The power of the curvature that slows down.', low=0.0, name='lambda'
    )
    v_linear_min: float = parameter(0.1, 'The lowest speed in m/s.', low=0.0)
    v_linear_max: float = parameter(0.5, 'The highest speed in m/s.', low=0.0)
    v_angular_max: float = parameter(1.0, 'The highest angular velocity in rad/s.', low=0.0)
    v_angular_min_in_place: float = parameter(
        0.25, 'The lowest angular velocity in rad/s when turning in place.', low=0.0
    )
    slowdown_radius: float = parameter(
        1.5, 'The distance in m from the goal within which to slow down.', low=0.0
    )
    initial_rotation: bool = parameter(
        True, 'Whether to turn to the path in place before the robot sets off.'
    )
    initial_rotation_tolerance: float = parameter(
        0.75, 'The angle in rad to the path below which it sets off.', low=0.0
    )
    prefer_final_rotation: bool = parameter(
        True, 'Whether to turn in place at the goal, rather than on the way to it.'
    )
    rotation_scaling_factor: float = parameter(
        0.5, 'The angular velocity per angle when turning in place, per v_angular_max.', low=0.0
    )
    allow_backward: bool = parameter(
        False, 'Whether to drive backward where the path leads backward.'
    )
    in_place_collision_resolution: float = parameter(
        0.1, 'The angle in rad between poses that are checked when turning in place.', low=0.01
    )
    use_collision_detection: bool = parameter(True, 'Whether to avoid collisions.')
