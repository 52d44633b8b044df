# SPDX-License-Identifier: Apache-2.0
"""Start navigation with a TurtleBot 3 in the loopback simulator, which needs no physics."""

from launch import LaunchDescription
from nav2_bringup.loopback import loopback_description


def generate_launch_description() -> LaunchDescription:
    """Start the simulator, the map server, navigation and RViz."""
    return loopback_description('tb3_sandbox.yaml', 'base_scan')
