# SPDX-License-Identifier: Apache-2.0
"""Show navigation in RViz."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    RegisterEventHandler,
)
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.substitutions import IfElseSubstitution, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare
from nav2_bringup.servers import declared, REMAPPINGS

VIEW = [FindPackageShare('nav2_bringup'), 'rviz', 'nav2_default_view.rviz']


def generate_launch_description() -> LaunchDescription:
    """Start RViz; the launch ends with it."""
    used = LaunchConfiguration('use_namespace')
    rviz = Node(
        package='rviz2',
        executable='rviz2',
        name='rviz2',
        namespace=IfElseSubstitution(used, LaunchConfiguration('namespace'), ''),
        arguments=['-d', LaunchConfiguration('rviz_config')],
        output='screen',
        parameters=[{'use_sim_time': LaunchConfiguration('use_sim_time')}],
        remappings=REMAPPINGS,
    )
    return LaunchDescription(
        [
            *declared('namespace', 'use_namespace', 'use_sim_time'),
            DeclareLaunchArgument(
                'rviz_config',
                default_value=PathJoinSubstitution(VIEW),
                description='Full path to the RViz configuration file.',
            ),
            rviz,
            RegisterEventHandler(
                OnProcessExit(target_action=rviz, on_exit=EmitEvent(event=Shutdown()))
            ),
        ]
    )
