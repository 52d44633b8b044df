# SPDX-License-Identifier: Apache-2.0
"""Show the robot description of any package in RViz, with sliders for its joints."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

# RViz in the browser has the sliders in a tab.
IN_RVIZ = {'own_page': False}


def generate_launch_description() -> LaunchDescription:
    """Return the robot description, a source of joint states, and RViz."""
    share = FindPackageShare('urdf_launch')
    default_view = PathJoinSubstitution([share, 'config', 'urdf.rviz'])
    view, sliders = LaunchConfiguration('rviz_config'), LaunchConfiguration('jsp_gui')
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'jsp_gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show sliders for the joints; without them, the joints are at zero.',
            ),
            DeclareLaunchArgument(
                'rviz_config', default_value=default_view, description='The view for RViz.'
            ),
            IncludeLaunchDescription(
                PathJoinSubstitution([share, 'launch', 'description.launch.py']),
                launch_arguments=[
                    (name, LaunchConfiguration(name))
                    for name in ('urdf_package', 'urdf_package_path')
                ],
            ),
            Node(
                package='joint_state_publisher',
                executable='joint_state_publisher',
                condition=UnlessCondition(sliders),
            ),
            Node(
                package='joint_state_publisher_gui',
                executable='joint_state_publisher_gui',
                parameters=[IN_RVIZ],
                condition=IfCondition(sliders),
            ),
            Node(package='rviz2', executable='rviz2', arguments=['-d', view], output='screen'),
        ]
    )
