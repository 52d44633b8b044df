# SPDX-License-Identifier: Apache-2.0
"""Show a model of the URDF tutorials in RViz, with sliders for its joints."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Return the arguments, and the launch file of `urdf_launch`."""
    share = FindPackageShare('urdf_launch')
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'model',
                default_value='urdf/01-myfirst.urdf',
                description='The URDF or xacro file: an absolute path, or relative to the share '
                'folder of urdf_tutorial.',
            ),
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='The name of jsp_gui in older tutorials.',
            ),
            DeclareLaunchArgument(
                'jsp_gui',
                default_value=LaunchConfiguration('gui'),
                choices=['true', 'false'],
                description='Show sliders for the joints; without them, the joints are at zero.',
            ),
            DeclareLaunchArgument(
                'rvizconfig',
                default_value=PathJoinSubstitution([share, 'config', 'urdf.rviz']),
                description='The view for RViz.',
            ),
            IncludeLaunchDescription(
                PathJoinSubstitution([share, 'launch', 'display.launch.py']),
                launch_arguments={
                    'urdf_package': 'urdf_tutorial',
                    'urdf_package_path': LaunchConfiguration('model'),
                    'jsp_gui': LaunchConfiguration('jsp_gui'),
                    'rviz_config': LaunchConfiguration('rvizconfig'),
                }.items(),
            ),
        ]
    )
