# SPDX-License-Identifier: Apache-2.0
"""Show the humanoid: with sliders and RViz, or only as transforms."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

# Joints follow these topics; without a message they stay where the sliders are, or at zero.
SOURCES = {'source_list': ['joint_commands']}
# RViz in the browser has the sliders in a panel; the RViz with a window ignores this.
IN_RVIZ = {'own_page': False}


def generate_launch_description() -> LaunchDescription:
    """Describe the nodes."""
    share = FindPackageShare('humanoid_description')
    model = PathJoinSubstitution([share, 'launch', 'description.launch.py'])
    view = PathJoinSubstitution([share, 'config', 'robot_view.rviz'])
    gui, prefix = LaunchConfiguration('gui'), LaunchConfiguration('prefix')
    forwarded = ('scale', 'prefix', 'upper_body_only', 'hands', 'colours', 'use_sim_time')
    time = {'use_sim_time': ParameterValue(LaunchConfiguration('use_sim_time'), value_type=bool)}
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show RViz, and sliders for the joints.',
            ),
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
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(model),
                launch_arguments=[(name, LaunchConfiguration(name)) for name in forwarded],
            ),
            Node(
                package='joint_state_publisher',
                executable='joint_state_publisher',
                parameters=[SOURCES, time],
                condition=UnlessCondition(gui),
            ),
            Node(
                package='joint_state_publisher_gui',
                executable='joint_state_publisher_gui',
                parameters=[SOURCES, IN_RVIZ, time],
                condition=IfCondition(gui),
            ),
            Node(
                package='rviz2',
                executable='rviz2',
                arguments=['-d', view, '-f', [prefix, 'base_link']],
                parameters=[time],
                condition=IfCondition(gui),
            ),
        ]
    )
