# SPDX-License-Identifier: Apache-2.0
"""Load a robot model from the package robot_description and report it."""

from __future__ import annotations

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    """Describe the node that reports the model."""
    urdf = Path(get_package_share_directory('robot_description')) / 'urdf' / 'simple_arm.urdf'
    return LaunchDescription(
        [
            Node(
                package='robot_control',
                executable='description_reporter',
                output='screen',
                parameters=[
                    {
                        'robot_description': ParameterValue(
                            urdf.read_text(encoding='utf-8'), value_type=str
                        ),
                    }
                ],
            ),
        ]
    )
