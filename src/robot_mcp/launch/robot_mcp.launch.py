# SPDX-License-Identifier: Apache-2.0
"""Let assistants reach the robot by HTTP on this machine."""

from __future__ import annotations

from humanoid_perception.places_choice import places_choice
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = (
    ('port', '8765', 'The port of the server; 0 for any free port.'),
    ('audit_log', '', 'The file in which each call is logged; empty for one in ROS_HOME.'),
    ('skills_file', '', 'The skills file; empty for the one in llm_planner.'),
    (
        'places_file',
        '',
        'Named places: a file, or the name of one in humanoid_perception; by default, that of '
        'the scene.',
    ),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Use the time of the topic /clock instead of the system clock.'),
)
SWITCHES = (
    (
        'allow_motion',
        'Whether assistants may make the robot act; looking and stopping are always allowed.',
    ),
    ('confirm', 'Whether a person has to confirm each action of the robot.'),
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
