# SPDX-License-Identifier: Apache-2.0
"""Start a service and a client; end when the client has ended."""

from launch import LaunchDescription
from launch.actions import Shutdown
from launch_ros.actions import Node


def generate_launch_description():
    """Describe both nodes."""
    return LaunchDescription(
        [
            Node(package='demo_nodes_cpp', executable='add_two_ints_server', output='screen'),
            Node(
                package='demo_nodes_cpp',
                executable='add_two_ints_client_async',
                output='screen',
                on_exit=Shutdown(),
            ),
        ]
    )
