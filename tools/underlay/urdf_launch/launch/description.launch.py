# SPDX-License-Identifier: Apache-2.0
"""Publish the robot description of any package, and the transforms of its joints."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Return the arguments that name the file, and the robot state publisher."""
    share = FindPackageShare(LaunchConfiguration('urdf_package'))
    file = PathJoinSubstitution([share, LaunchConfiguration('urdf_package_path')])
    urdf = ParameterValue(Command(['xacro "', file, '"']), value_type=str)
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'urdf_package', description='The package that has the robot description.'
            ),
            DeclareLaunchArgument(
                'urdf_package_path',
                description='The URDF or xacro file, relative to the share folder of the package.',
            ),
            Node(
                package='robot_state_publisher',
                executable='robot_state_publisher',
                parameters=[{'robot_description': urdf}],
            ),
        ]
    )
