# SPDX-License-Identifier: Apache-2.0
"""Start navigation: map server and AMCL or SLAM, and the navigation servers."""

from __future__ import annotations

from typing import Any

from launch import LaunchDescription
from launch.actions import GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (
    AndSubstitution,
    LaunchConfiguration,
    NotSubstitution,
    PathJoinSubstitution,
)
from launch_ros.actions import Node, PushROSNamespace
from launch_ros.substitutions import FindPackageShare
from nav2_bringup.servers import configured_parameters, declared, DESCRIPTIONS, REMAPPINGS

PASSED_ON = ('namespace', 'use_sim_time', 'autostart', 'params_file', 'use_respawn', 'log_level')


def generate_launch_description() -> LaunchDescription:
    """Start the container, if requested, and include the other launch files."""
    slam, localization = LaunchConfiguration('slam'), LaunchConfiguration('use_localization')
    names = [name for name in DESCRIPTIONS if name != 'container_name']
    composed = {
        'use_composition': LaunchConfiguration('use_composition'),
        'container_name': 'nav2_container',
    }
    return LaunchDescription(
        [
            *declared(*names),
            GroupAction(
                [
                    PushROSNamespace(
                        LaunchConfiguration('namespace'),
                        condition=IfCondition(LaunchConfiguration('use_namespace')),
                    ),
                    Node(
                        condition=IfCondition(LaunchConfiguration('use_composition')),
                        name='nav2_container',
                        package='rclcpp_components',
                        executable='component_container',
                        parameters=[
                            configured_parameters(),
                        ],
                        arguments=['--ros-args', '--log-level', LaunchConfiguration('log_level')],
                        remappings=REMAPPINGS,
                        respawn=LaunchConfiguration('use_respawn'),
                        respawn_delay=2.0,
                        output='screen',
                    ),
                    _include('slam', AndSubstitution(slam, localization)),
                    _include(
                        'localization',
                        AndSubstitution(NotSubstitution(slam), localization),
                        map=LaunchConfiguration('map'),
                        **composed,
                    ),
                    _include('navigation', 'True', **composed),
                ]
            ),
        ]
    )


def _include(name: str, condition: Any, **arguments: Any) -> IncludeLaunchDescription:
    path = [FindPackageShare('nav2_bringup'), 'launch', f'{name}_launch.py']
    passed = {argument: LaunchConfiguration(argument) for argument in PASSED_ON}
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(PathJoinSubstitution(path)),
        condition=IfCondition(condition),
        launch_arguments={**passed, **arguments}.items(),
    )
