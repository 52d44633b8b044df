# SPDX-License-Identifier: Apache-2.0
"""Start several joint controllers, each in a namespace of its own."""

from __future__ import annotations

from humanoid_bringup.launch_arguments import robot_namespaces
from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe as many controllers as the argument `robots` says."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'robots',
                default_value='3',
                description='The number of robots, which are named robot1, robot2 and so on.',
            ),
            OpaqueFunction(function=_controllers),
        ]
    )


def _controllers(context: LaunchContext) -> list[Node]:
    """Return one controller for each robot."""
    count = LaunchConfiguration('robots').perform(context)
    return [_controller(namespace) for namespace in robot_namespaces(count)]


def _controller(namespace: str) -> Node:
    """Return the controller of the robot in the namespace."""
    return Node(
        package='humanoid_control',
        executable='joint_controller',
        namespace=namespace,
        output='screen',
        parameters=[
            PathJoinSubstitution(
                [FindPackageShare('humanoid_control'), 'config', 'joint_controller.yaml']
            )
        ],
    )
