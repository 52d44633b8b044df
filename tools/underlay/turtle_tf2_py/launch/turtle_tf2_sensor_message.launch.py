# SPDX-License-Identifier: Apache-2.0
"""Start two turtles, and publish where the other one is as stamped points."""

from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return the turtles, their broadcasters, and the node that publishes points."""
    return LaunchDescription(
        [
            Node(package='turtlesim', executable='turtlesim_node', name='sim', output='screen'),
            *(
                Node(
                    package='turtle_tf2_py',
                    executable='turtle_tf2_broadcaster',
                    name=f'broadcaster{number}',
                    parameters=[{'turtlename': f'turtle{number}'}],
                )
                for number in (1, 3)
            ),
            Node(
                package='turtle_tf2_py',
                executable='turtle_tf2_message_broadcaster',
                name='message_broadcaster',
            ),
        ]
    )
