# SPDX-License-Identifier: Apache-2.0
"""Start two turtles, of which the second one follows the first one, or another frame."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description() -> LaunchDescription:
    """Return the turtles, a broadcaster for each, and the node that follows."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'target_frame',
                default_value='turtle1',
                description='The frame that the second turtle follows.',
            ),
            Node(package='turtlesim', executable='turtlesim_node', name='sim'),
            *(
                Node(
                    package='turtle_tf2_py',
                    executable='turtle_tf2_broadcaster',
                    name=f'broadcaster{number}',
                    parameters=[{'turtlename': f'turtle{number}'}],
                )
                for number in (1, 2)
            ),
            Node(
                package='turtle_tf2_py',
                executable='turtle_tf2_listener',
                name='listener',
                parameters=[{'target_frame': LaunchConfiguration('target_frame')}],
            ),
        ]
    )
