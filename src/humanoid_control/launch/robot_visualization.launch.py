# SPDX-License-Identifier: Apache-2.0
"""Move the humanoid and show it: in RViz with sliders, or only as transforms."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, SetParameter
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the controller, and include what shows the model."""
    config = PathJoinSubstitution([FindPackageShare('humanoid_control'), 'config'])
    view = [FindPackageShare('humanoid_description'), 'launch', 'view.launch.py']
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='false',
                choices=['true', 'false'],
                description='Take the time from the topic /clock instead of the computer.',
            ),
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show RViz, and sliders for the joints.',
            ),
            SetParameter(name='use_sim_time', value=LaunchConfiguration('use_sim_time')),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(PathJoinSubstitution(view)),
                launch_arguments={'gui': LaunchConfiguration('gui')}.items(),
            ),
            Node(
                package='humanoid_control',
                executable='joint_controller',
                output='screen',
                parameters=[PathJoinSubstitution([config, 'joint_controller.yaml'])],
            ),
        ]
    )
