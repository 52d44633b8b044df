# SPDX-License-Identifier: Apache-2.0
"""Start the talker, its listener, and the client that leads it through its states."""

from launch import LaunchDescription
from launch.actions import Shutdown
from launch_ros.actions import LifecycleNode, Node


def generate_launch_description() -> LaunchDescription:
    """Return the three nodes; the launch ends with the client."""
    return LaunchDescription(
        [
            LifecycleNode(
                package='lifecycle',
                executable='lifecycle_talker',
                name='lc_talker',
                namespace='',
                output='screen',
            ),
            Node(package='lifecycle', executable='lifecycle_listener', output='screen'),
            Node(
                package='lifecycle',
                executable='lifecycle_service_client',
                output='screen',
                on_exit=Shutdown(),
            ),
        ]
    )
