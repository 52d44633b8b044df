# SPDX-License-Identifier: Apache-2.0
"""Let the humanoid reach with its arms."""

from __future__ import annotations

from humanoid_perception.places_choice import places_choice
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

ARGUMENTS = (
    (
        'places_file',
        '',
        'Named places: a file, or the name of one in humanoid_perception; by default, that of '
        'the scene.',
    ),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Use the time of the topic /clock instead of the system clock.'),
)


def generate_launch_description() -> LaunchDescription:
    """Start the node, anew if it ends."""
    time = ParameterValue(LaunchConfiguration('use_sim_time'), value_type=bool)
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            Node(
                package='humanoid_manipulation',
                executable='manipulator',
                namespace=LaunchConfiguration('namespace'),
                output='screen',
                respawn=True,
                respawn_delay=2.0,
                parameters=[{'places_file': places_choice(), 'use_sim_time': time}],
            ),
        ]
    )
