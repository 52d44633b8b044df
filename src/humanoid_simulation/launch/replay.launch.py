# SPDX-License-Identifier: Apache-2.0
"""Show a finished run of a sweep in RViz."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the nodes; `sweep --replay` starts this with the arguments of a run."""
    description = [FindPackageShare('humanoid_description'), 'launch', 'description.launch.py']
    view = [FindPackageShare('humanoid_simulation'), 'config', 'replay.rviz']
    given = {
        name: ParameterValue(LaunchConfiguration(name), value_type=kind)
        for name, kind in (('record', str), ('key', str), ('speed', float))
    }
    return LaunchDescription(
        [
            DeclareLaunchArgument('record', description='The file runs.jsonl of a sweep.'),
            DeclareLaunchArgument(
                'key', description='The key of a finished run, or its first digits.'
            ),
            DeclareLaunchArgument(
                'speed', default_value='1.0', description='Simulated seconds per real second.'
            ),
            DeclareLaunchArgument(
                'hands',
                default_value='false',
                choices=['true', 'false'],
                description='Whether the robot of the run has wrists and grippers.',
            ),
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show the robot in RViz.',
            ),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(PathJoinSubstitution(description)),
                launch_arguments=[('hands', LaunchConfiguration('hands'))],
            ),
            Node(
                package='humanoid_simulation',
                executable='replay',
                output='screen',
                parameters=[given],
            ),
            Node(
                package='rviz2',
                executable='rviz2',
                arguments=['-d', PathJoinSubstitution(view)],
                condition=IfCondition(LaunchConfiguration('gui')),
            ),
        ]
    )
