# SPDX-License-Identifier: Apache-2.0
"""The parameters of the controller server, besides those of its plugins."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_util.parameters import parameter

__all__ = ['UNSUPPORTED', 'ServerParameters']

UNSUPPORTED = {
    'search_window': 'max_robot_pose_search_dist of the controller plugins says how far',
    'controller_plugin_ids': 'set controller_plugins',
    'controller_plugin_types': 'set <name>.plugin for each name in controller_plugins',
}


@dataclass(frozen=True)
class ServerParameters:
    """The parameters of the controller server."""

    controller_frequency: float = parameter(
        20.0, 'How often in Hz a velocity is computed.', low=0.1, high=1000.0
    )
    costmap_update_timeout: float = parameter(
        0.3, 'How long in s to wait for a local costmap that is up to date.', low=0.0
    )
    publish_zero_velocity: bool = parameter(
        True, 'Whether to publish a zero velocity when a goal ends.'
    )
    controller_plugins: list[str] = parameter(['FollowPath'], 'The names of controllers.')
    progress_checker_plugins: list[str] = parameter(
        ['progress_checker'], 'The names of checkers of progress.'
    )
    goal_checker_plugins: list[str] = parameter(
        ['goal_checker'], 'The names of checkers of the goal.'
    )
    min_x_velocity_threshold: float = parameter(
        0.0001, 'A velocity of the odometry along x in m/s below which it counts as 0.', low=0.0
    )
    min_y_velocity_threshold: float = parameter(
        0.0001, 'A velocity of the odometry along y in m/s below which it counts as 0.', low=0.0
    )
    min_theta_velocity_threshold: float = parameter(
        0.0001, 'An angular velocity in rad/s below which it counts as 0.', low=0.0
    )
    failure_tolerance: float = parameter(
        0.0,
        'How long in s the robot stands and tries on when there is no velocity; -1: for ever.',
        low=-1.0,
    )
    speed_limit_topic: str = parameter('speed_limit', 'The topic of speed limits.')
    odom_topic: str = parameter('odom', 'The topic of the odometry.')
    odom_duration: float = parameter(
        0.3, 'The time in s over which velocities of the odometry are averaged.', low=0.0
    )
    use_realtime_priority: bool = parameter(
        False, 'Has no effect: all nodes of a process run with its priority.'
    )
    enable_stamped_cmd_vel: bool = parameter(
        False, "Whether TwistStamped is published on 'cmd_vel', and not Twist."
    )
