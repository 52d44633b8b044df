# SPDX-License-Identifier: Apache-2.0
"""Start two turtles, of which the second one follows a carrot that goes around the first one."""

from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Return the turtles, which follow `carrot1`, and the node that broadcasts it."""
    demo = [FindPackageShare('turtle_tf2_py'), 'launch', 'turtle_tf2_demo.launch.py']
    return LaunchDescription(
        [
            IncludeLaunchDescription(
                PathJoinSubstitution(demo),
                launch_arguments={'target_frame': 'carrot1'}.items(),
            ),
            Node(
                package='turtle_tf2_py',
                executable='dynamic_frame_tf2_broadcaster',
                name='dynamic_broadcaster',
            ),
        ]
    )
