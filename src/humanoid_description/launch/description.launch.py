# SPDX-License-Identifier: Apache-2.0
"""Publish the model of the humanoid, and the transforms of its joints."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the robot state publisher."""
    share = FindPackageShare('humanoid_description')
    urdf = ['xacro "', PathJoinSubstitution([share, 'urdf', 'humanoid.urdf.xacro']), '"']
    for argument in ('scale', 'prefix', 'upper_body_only', 'hands', 'colours'):
        urdf += [f' {argument}:=', LaunchConfiguration(argument)]
    description = {'robot_description': ParameterValue(Command(urdf), value_type=str)}
    time = {'use_sim_time': ParameterValue(LaunchConfiguration('use_sim_time'), value_type=bool)}
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
                'upper_body_only',
                default_value='false',
                choices=['true', 'false'],
                description='Leave out the legs.',
            ),
            DeclareLaunchArgument(
                'hands',
                default_value='false',
                choices=['true', 'false'],
                description='Add wrists and grippers to the arms.',
            ),
            DeclareLaunchArgument(
                'colours',
                default_value='light',
                choices=['light', 'dark'],
                description='Colour scheme of the robot.',
            ),
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=['true', 'false'],
                description='Use the time of the topic /clock instead of the system clock.',
            ),
            Node(
                package='robot_state_publisher',
                executable='robot_state_publisher',
                respawn=True,
                respawn_delay=2.0,
                parameters=[description, time],
            ),
        ]
    )
