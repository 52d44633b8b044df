# SPDX-License-Identifier: Apache-2.0
"""Start the navigation servers: planner, controller, smoother, behaviours and others."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import GroupAction
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from nav2_bringup.servers import declared, Server, server_actions
from nav2_common.launch import HasNodeParams

TO_SMOOTHER = [('cmd_vel', 'cmd_vel_nav')]
SERVERS = [
    Server(
        'nav2_controller',
        'controller_server',
        'nav2_controller::ControllerServer',
        'controller_server',
        TO_SMOOTHER,
    ),
    Server('nav2_smoother', 'smoother_server', 'nav2_smoother::SmootherServer', 'smoother_server'),
    Server('nav2_planner', 'planner_server', 'nav2_planner::PlannerServer', 'planner_server'),
    Server(
        'nav2_behaviors',
        'behavior_server',
        'behavior_server::BehaviorServer',
        'behavior_server',
        TO_SMOOTHER,
    ),
    Server(
        'nav2_velocity_smoother',
        'velocity_smoother',
        'nav2_velocity_smoother::VelocitySmoother',
        'velocity_smoother',
        TO_SMOOTHER,
    ),
    Server(
        'nav2_collision_monitor',
        'collision_monitor',
        'nav2_collision_monitor::CollisionMonitor',
        'collision_monitor',
    ),
    Server('nav2_bt_navigator', 'bt_navigator', 'nav2_bt_navigator::BtNavigator', 'bt_navigator'),
    Server(
        'nav2_waypoint_follower',
        'waypoint_follower',
        'nav2_waypoint_follower::WaypointFollower',
        'waypoint_follower',
    ),
]
DOCKING = Server(
    'opennav_docking',
    'opennav_docking',
    'opennav_docking::DockingServer',
    'docking_server',
    TO_SMOOTHER,
)
MANAGER = 'lifecycle_manager_navigation'


def generate_launch_description() -> LaunchDescription:
    """Start the servers and their manager; that of docks if it has parameters."""
    has_docks = HasNodeParams(LaunchConfiguration('params_file'), 'docking_server')
    return LaunchDescription(
        [
            *declared(
                'namespace',
                'use_sim_time',
                'params_file',
                'autostart',
                'use_composition',
                'container_name',
                'use_respawn',
                'log_level',
                use_composition='False',
            ),
            GroupAction(
                server_actions([*SERVERS, DOCKING], MANAGER), condition=IfCondition(has_docks)
            ),
            GroupAction(server_actions(SERVERS, MANAGER), condition=UnlessCondition(has_docks)),
        ]
    )
