# SPDX-License-Identifier: Apache-2.0
"""Move the humanoid and show it: in RViz with sliders, or only as transforms."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the controller, and include what shows the model."""
    config = PathJoinSubstitution([FindPackageShare('humanoid_control'), 'config'])
    use_sim_time = LaunchConfiguration('use_sim_time')
    time = {'use_sim_time': ParameterValue(use_sim_time, value_type=bool)}
    view = [FindPackageShare('humanoid_description'), 'launch', 'view.launch.py']
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=['true', 'false'],
                description='Use the time of the topic /clock instead of the system clock.',
            ),
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show RViz, and sliders for the joints.',
            ),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(PathJoinSubstitution(view)),
                launch_arguments={
                    'gui': LaunchConfiguration('gui'),
                    'use_sim_time': use_sim_time,
                }.items(),
            ),
            Node(
                package='humanoid_control',
                executable='joint_controller',
                output='screen',
                parameters=[PathJoinSubstitution([config, 'joint_controller.yaml']), time],
            ),
        ]
    )
