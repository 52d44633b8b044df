# SPDX-License-Identifier: Apache-2.0
"""Start the thermometer and the node that warns."""

from __future__ import annotations

from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe both nodes, with the numbers of their configuration files."""
    config = PathJoinSubstitution([FindPackageShare('temperature_monitor'), 'config'])
    return LaunchDescription(
        [
            Node(
                package='temperature_monitor',
                executable='temp_publisher',
                output='screen',
                parameters=[PathJoinSubstitution([config, 'temp_publisher.yaml'])],
            ),
            Node(
                package='temperature_monitor',
                executable='temp_analyzer',
                output='screen',
                parameters=[PathJoinSubstitution([config, 'temp_analyzer.yaml'])],
            ),
        ]
    )
