# SPDX-License-Identifier: Apache-2.0
"""Start the joint controller and the sensor processor."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe both nodes, with the numbers of their configuration files."""
    config = PathJoinSubstitution([FindPackageShare('humanoid_control'), 'config'])
    use_sim_time = {
        'use_sim_time': ParameterValue(LaunchConfiguration('use_sim_time'), value_type=bool)
    }
    report_period = {
        'report_period_s': ParameterValue(LaunchConfiguration('report_period_s'), value_type=float)
    }
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'use_controller',
                default_value='true',
                choices=['true', 'false'],
                description='Start the joint controller.',
            ),
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=['true', 'false'],
                description='Use the time of the topic /clock instead of the system clock.',
            ),
            DeclareLaunchArgument(
                'report_period_s',
                default_value='1.0',
                description='Seconds between two logs of the first joint by the sensor processor.',
            ),
            Node(
                package='humanoid_control',
                executable='joint_controller',
                output='screen',
                respawn=True,
                respawn_delay=2.0,
                parameters=[PathJoinSubstitution([config, 'joint_controller.yaml']), use_sim_time],
                condition=IfCondition(LaunchConfiguration('use_controller')),
            ),
            Node(
                package='humanoid_control',
                executable='sensor_processor',
                output='screen',
                respawn=True,
                respawn_delay=2.0,
                parameters=[
                    PathJoinSubstitution([config, 'sensor_processor.yaml']),
                    use_sim_time,
                    report_period,
                ],
            ),
        ]
    )
