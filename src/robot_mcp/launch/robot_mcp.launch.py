# SPDX-License-Identifier: Apache-2.0
"""Let assistants reach the robot by HTTP on this machine."""

from __future__ import annotations

from humanoid_perception.places_choice import places_choice
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = (
    ('port', '8765', 'The port of the server; 0 for any.'),
    ('audit_log', '', 'The file in which each call is noted; empty for one in ROS_HOME.'),
    ('skills_file', '', 'What the robot can be asked for; empty for the file of llm_planner.'),
    (
        'places_file',
        '',
        'Named places: a file, or the name of one of humanoid_perception; else by scene.',
    ),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Take the time from the topic /clock instead of the computer.'),
)
SWITCHES = (
    ('allow_motion', 'Whether assistants may make the robot do anything but stop.'),
    ('confirm', 'Whether a person has to agree to each thing that the robot does.'),
)
TOLD = ('port', 'audit_log', 'skills_file', 'use_sim_time', 'allow_motion', 'confirm')


def generate_launch_description() -> LaunchDescription:
    """Start the server."""
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            *(
                DeclareLaunchArgument(
                    name,
                    default_value='false',
                    choices=['true', 'false'],
                    description=description,
                )
                for name, description in SWITCHES
            ),
            Node(
                package='robot_mcp',
                executable='robot_mcp',
                namespace=LaunchConfiguration('namespace'),
                output='screen',
                parameters=[
                    {
                        'transport': 'http',
                        'places_file': places_choice(),
                        **{name: LaunchConfiguration(name) for name in TOLD},
                    }
                ],
            ),
        ]
    )
