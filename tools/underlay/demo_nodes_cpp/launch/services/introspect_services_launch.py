# SPDX-License-Identifier: Apache-2.0
"""Start a service and a client whose calls can be shown."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    """Describe both nodes."""
    return LaunchDescription(
        [
            Node(package='demo_nodes_cpp', executable='introspection_service', output='screen'),
            Node(package='demo_nodes_cpp', executable='introspection_client', output='screen'),
        ]
    )
