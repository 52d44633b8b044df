# SPDX-License-Identifier: Apache-2.0
"""Start a robot without physics: its joints do what they are told."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the node, with the numbers of its configuration file."""
    config = [FindPackageShare('humanoid_control'), 'config', 'mock_robot.yaml']
    given = {
        'scale': ParameterValue(LaunchConfiguration('scale'), value_type=float),
        'prefix': ParameterValue(LaunchConfiguration('prefix'), value_type=str),
        'hands': ParameterValue(LaunchConfiguration('hands'), value_type=bool),
        'use_sim_time': ParameterValue(LaunchConfiguration('use_sim_time'), value_type=bool),
    }
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'scale', default_value='1.0', description='Size of the humanoid, 0.5 to 1.3.'
            ),
            DeclareLaunchArgument(
                'prefix',
                default_value='',
                description='Prefix of the names of all links and joints.',
            ),
            DeclareLaunchArgument(
                'hands',
                default_value='false',
                choices=['true', 'false'],
                description='Add wrists and grippers to the arms.',
            ),
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=['true', 'false'],
                description='Use the time of the topic /clock instead of the system clock.',
            ),
            Node(
                package='humanoid_control',
                executable='mock_robot',
                output='screen',
                parameters=[PathJoinSubstitution(config), given],
            ),
        ]
    )
