# SPDX-License-Identifier: Apache-2.0
"""Start the humanoid: everything that there is."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare

VIEW = 'view.launch.py'


def generate_launch_description() -> LaunchDescription:
    """Compose the launch files of the other packages."""
    use_sim_time = LaunchConfiguration('use_sim_time')
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
                description='Take the time from the topic /clock instead of the computer.',
            ),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(
                    PathJoinSubstitution(
                        [FindPackageShare('humanoid_control'), 'launch', 'robot_bringup.launch.py']
                    )
                ),
                launch_arguments={
                    'use_controller': LaunchConfiguration('use_controller'),
                    'use_sim_time': use_sim_time,
                }.items(),
            ),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(
                    PathJoinSubstitution(
                        [FindPackageShare('humanoid_description'), 'launch', VIEW]
                    )
                ),
                launch_arguments={'gui': 'false', 'use_sim_time': use_sim_time}.items(),
            ),
        ]
    )
