# SPDX-License-Identifier: Apache-2.0
"""Start a talker and a listener."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    """Describe both nodes."""
    return LaunchDescription(
        [
            Node(package='demo_nodes_cpp', executable='talker', output='screen'),
            Node(package='demo_nodes_cpp', executable='listener', output='screen'),
        ]
    )
