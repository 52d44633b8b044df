# SPDX-License-Identifier: Apache-2.0
"""Start the humanoid: everything that there is."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Compose the launch files of the packages."""
    gui, use_sim_time = LaunchConfiguration('gui'), LaunchConfiguration('use_sim_time')
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
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show the robot in RViz, with what one drives and watches it with.',
            ),
            GroupAction([_include('humanoid_bringup', 'console')], condition=IfCondition(gui)),
            _include(
                'humanoid_control',
                'robot_bringup',
                use_controller=LaunchConfiguration('use_controller'),
                use_sim_time=use_sim_time,
            ),
            GroupAction(
                [_include('humanoid_description', 'view', gui='false', use_sim_time=use_sim_time)]
            ),
        ]
    )


def _include(
    package: str, name: str, **arguments: str | LaunchConfiguration
) -> IncludeLaunchDescription:
    """Include a launch file of a package."""
    path = [FindPackageShare(package), 'launch', f'{name}.launch.py']
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(PathJoinSubstitution(path)),
        launch_arguments=arguments.items(),
    )
