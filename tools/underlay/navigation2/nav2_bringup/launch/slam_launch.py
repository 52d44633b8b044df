# SPDX-License-Identifier: Apache-2.0
"""Start SLAM: slam_toolbox, and map_saver to save the map."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import GroupAction, IncludeLaunchDescription, SetLaunchConfiguration
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import SetRemap
from launch_ros.substitutions import FindPackageShare
from nav2_bringup.servers import declared, Server, server_actions
from nav2_common.launch import HasNodeParams

SERVERS = [Server('nav2_map_server', 'map_saver_server', 'nav2_map_server::MapSaver', 'map_saver')]


def generate_launch_description() -> LaunchDescription:
    """Start slam_toolbox, with the parameter file if it has parameters for the node."""
    slam = PythonLaunchDescriptionSource(
        PathJoinSubstitution(
            [FindPackageShare('slam_toolbox'), 'launch', 'online_async_launch.py']
        )
    )
    use_sim_time = LaunchConfiguration('use_sim_time')
    given = HasNodeParams(LaunchConfiguration('params_file'), 'slam_toolbox')
    return LaunchDescription(
        [
            *declared(
                'namespace', 'params_file', 'use_sim_time', 'autostart', 'use_respawn', 'log_level'
            ),
            GroupAction(
                [
                    SetLaunchConfiguration('use_composition', 'False'),
                    *server_actions(SERVERS, 'lifecycle_manager_slam'),
                ]
            ),
            GroupAction(
                [
                    SetRemap('/map', 'map'),
                    SetRemap('/tf', 'tf'),
                    SetRemap('/tf_static', 'tf_static'),
                    IncludeLaunchDescription(
                        slam,
                        launch_arguments={'use_sim_time': use_sim_time}.items(),
                        condition=UnlessCondition(given),
                    ),
                    IncludeLaunchDescription(
                        slam,
                        launch_arguments={
                            'use_sim_time': use_sim_time,
                            'slam_params_file': LaunchConfiguration('params_file'),
                        }.items(),
                        condition=IfCondition(given),
                    ),
                ]
            ),
        ]
    )
