# SPDX-License-Identifier: Apache-2.0
"""Let the humanoid find its way: Nav2 with its parameters, and what ends goals when it falls."""

from __future__ import annotations

from humanoid_navigation.map_choice import map_choice
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (
    IfElseSubstitution,
    LaunchConfiguration,
    NotEqualsSubstitution,
    PathJoinSubstitution,
)
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

ARGUMENTS = (
    (
        'map',
        '',
        'The map: a YAML file, or the name of a map of this package; by default, that of the '
        'scene.',
    ),
    ('slam', 'False', 'Whether to make a map (SLAM) instead of using one.'),
    (
        'params_file',
        PathJoinSubstitution(
            [FindPackageShare('humanoid_navigation'), 'config', 'nav2_params.yaml']
        ),
        'The parameter file of all Nav2 nodes.',
    ),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Use the time of the topic /clock instead of the system clock.'),
    ('use_composition', 'True', 'Whether all nodes of Nav2 share one process.'),
    ('use_respawn', 'True', 'Whether to restart processes that exit.'),
)
PASSED_ON = ('slam', 'params_file', 'namespace', 'use_sim_time', 'use_composition', 'use_respawn')


def generate_launch_description() -> LaunchDescription:
    """Include Nav2's own launch file."""
    nav2 = [FindPackageShare('nav2_bringup'), 'launch', 'bringup_launch.py']
    passed = {name: LaunchConfiguration(name) for name in PASSED_ON}
    named = NotEqualsSubstitution(LaunchConfiguration('namespace'), '')
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            *(
                GroupAction(
                    [
                        IncludeLaunchDescription(
                            PythonLaunchDescriptionSource(PathJoinSubstitution(nav2)),
                            launch_arguments={
                                **passed,
                                'use_namespace': IfElseSubstitution(named, 'True', 'False'),
                                'map': chosen,
                            }.items(),
                        )
                    ],
                    condition=condition(LaunchConfiguration('slam')),
                )
                for condition, chosen in ((UnlessCondition, map_choice()), (IfCondition, ''))
            ),
            Node(
                package='humanoid_navigation',
                executable='navigation_guard',
                namespace=LaunchConfiguration('namespace'),
                output='screen',
                respawn=LaunchConfiguration('use_respawn'),
                parameters=[{'use_sim_time': LaunchConfiguration('use_sim_time')}],
            ),
        ]
    )
