# SPDX-License-Identifier: Apache-2.0
"""Start the loopback simulator in place of a robot; start navigation separately."""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    """Describe the simulator and the static transform that connects the robot's model to it."""
    bringup = get_package_share_directory('nav2_bringup')
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'params_file',
                default_value=os.path.join(bringup, 'params', 'nav2_params.yaml'),
                description='The parameter file of the nodes, with a section loopback_simulator.',
            ),
            DeclareLaunchArgument(
                'scan_frame_id',
                default_value='base_scan',
                description='The frame of the laser scanner.',
            ),
            Node(
                package='nav2_loopback_sim',
                executable='loopback_simulator',
                name='loopback_simulator',
                output='screen',
                parameters=[
                    LaunchConfiguration('params_file'),
                    {'scan_frame_id': LaunchConfiguration('scan_frame_id')},
                ],
            ),
            Node(
                package='tf2_ros',
                executable='static_transform_publisher',
                name='base_footprint_to_base_link',
                arguments=['--frame-id', 'base_footprint', '--child-frame-id', 'base_link'],
            ),
        ]
    )
