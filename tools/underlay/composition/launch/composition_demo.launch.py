# SPDX-License-Identifier: Apache-2.0
"""Start a container with a talker and a listener."""

from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description() -> LaunchDescription:
    """Return the container."""
    components = (('composition::Talker', 'talker'), ('composition::Listener', 'listener'))
    container = ComposableNodeContainer(
        name='my_container',
        namespace='',
        package='rclcpp_components',
        executable='component_container',
        composable_node_descriptions=[
            ComposableNode(package='composition', plugin=plugin, name=name)
            for plugin, name in components
        ],
        output='screen',
    )
    return LaunchDescription([container])
