# SPDX-License-Identifier: Apache-2.0
"""Start two turtlesims, each in a namespace of its own."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return the two nodes."""
    return LaunchDescription(
        [
            Node(
                package='turtlesim',
                executable='turtlesim_node',
                namespace=namespace,
                output='screen',
            )
            for namespace in ('turtlesim1', 'turtlesim2')
        ]
    )
