# SPDX-License-Identifier: Apache-2.0
"""Start a discovery server, through which nodes on several machines find each other."""

from __future__ import annotations

from humanoid_bringup.discovery_server import DEFAULT_PORT, discovery_server
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction


def generate_launch_description() -> LaunchDescription:
    """Describe the server."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'address',
                default_value='',
                description='The address of this machine at which nodes reach the server; each '
                'of them if empty, or 0.0.0.0.',
            ),
            DeclareLaunchArgument(
                'port',
                default_value=str(DEFAULT_PORT),
                description='The UDP port of the server, 1025 to 65535.',
            ),
            DeclareLaunchArgument(
                'server_id',
                default_value='0',
                description='Which of several servers it is, 0 to 255: its position in '
                'ROS_DISCOVERY_SERVER.',
            ),
            OpaqueFunction(function=discovery_server),
        ]
    )
