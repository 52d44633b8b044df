# SPDX-License-Identifier: Apache-2.0
"""Show the humanoid in RViz, with what one drives and watches it with."""

from __future__ import annotations

from humanoid_bringup.crash_proof import crash_proof, Once
from humanoid_bringup.launch_arguments import WholeNumber
from humanoid_bringup.rviz_file import RvizFile
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import (
    EqualsSubstitution,
    IfElseSubstitution,
    LaunchConfiguration,
    PathJoinSubstitution,
)
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the node; an RViz with a window of its own leaves the arguments aside."""
    navigates = EqualsSubstitution(LaunchConfiguration('navigation', default='false'), 'true')
    name = IfElseSubstitution(navigates, 'navigation.rviz', 'console.rviz')
    folder = [FindPackageShare('humanoid_bringup'), 'config']
    config = RvizFile(
        PathJoinSubstitution([*folder, name]),
        PathJoinSubstitution([*folder, 'perception_displays.rviz']),
        LaunchConfiguration('perception', default='false'),
    )
    frame = IfElseSubstitution(navigates, 'map', 'odom')
    arguments = ['-d', Once(config), '-f', Once(LaunchConfiguration('prefix'), frame)]
    kinds = {'host': str, 'token': str, 'use_sim_time': bool}
    port = WholeNumber('port', range(65536), 8090)
    page = {
        name: ParameterValue(Once(LaunchConfiguration(name)), value_type=kind)
        for name, kind in kinds.items()
    }
    page['port'] = ParameterValue(Once(port), value_type=int)
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'host',
                default_value='127.0.0.1',
                description='The address of the page; 0.0.0.0 opens it to other machines.',
            ),
            DeclareLaunchArgument(
                'port',
                default_value='0',
                description='The port of the page; 0 takes the first free one from 8080 up.',
            ),
            DeclareLaunchArgument(
                'token',
                default_value='',
                description='The token that opens the page; generated if empty, "none" for none.',
            ),
            DeclareLaunchArgument(
                'prefix',
                default_value='',
                description='Prefix of the names of all links and joints.',
            ),
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=['true', 'false'],
                description='Use the time of the topic /clock instead of the system clock.',
            ),
            crash_proof(
                lambda **options: Node(
                    package='rviz2',
                    executable='rviz2',
                    output='screen',
                    arguments=arguments,
                    parameters=[page],
                    **options,
                )
            ),
        ]
    )
