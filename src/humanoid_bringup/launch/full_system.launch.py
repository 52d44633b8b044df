# SPDX-License-Identifier: Apache-2.0
"""Start the whole humanoid in a home: it finds its way, sees, and does what it is told."""

from __future__ import annotations

from humanoid_bringup.launch_arguments import robot_time
from launch import LaunchDescription, Substitution
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (
    LaunchConfiguration,
    NotEqualsSubstitution,
    PathJoinSubstitution,
)
from launch_ros.substitutions import FindPackageShare

DEFAULTS = {
    'scene': ('apartment', 'The scene that is simulated.'),
    'navigation': ('true', 'Start Nav2, for autonomous navigation.'),
    'perception': ('true', 'Detect objects, remember where they are, and look for them.'),
    'hands': ('true', 'Add wrists and grippers to the arms.'),
    'manipulation': (
        'true',
        'Pick up objects, carry them, and put them down; the robot needs hands.',
    ),
    'assistants_port': ('8765', 'The port of the MCP server; 0 for any free one.'),
}

PARTS = {
    'planner': ('true', 'Understand commands, and carry them out.'),
    'voice': ('true', 'Listen for spoken commands, and speak the replies of the robot aloud.'),
    'assistants': ('false', 'Let MCP assistants control the robot, over HTTP.'),
}


def generate_launch_description() -> LaunchDescription:
    """Compose the humanoid and what makes use of it."""
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, (default, description) in DEFAULTS.items()
            ),
            *(
                DeclareLaunchArgument(
                    name,
                    default_value=default,
                    choices=['true', 'false'],
                    description=description,
                )
                for name, (default, description) in PARTS.items()
            ),
            _include('humanoid_bringup', 'bringup'),
            _part('planner', 'llm_planner', 'planner'),
            _part('voice', 'voice_control', 'voice'),
            _part(
                'assistants',
                'robot_mcp',
                'robot_mcp',
                {
                    # These names mean something else to the page and to the planner.
                    'port': LaunchConfiguration('assistants_port'),
                    'confirm': NotEqualsSubstitution(
                        LaunchConfiguration('confirm', default='never'), 'never'
                    ),
                },
            ),
        ]
    )


def _part(
    argument: str, package: str, name: str, arguments: dict[str, Substitution] | None = None
) -> GroupAction:
    """Include a launch file of a package if an argument says so."""
    given = {'use_sim_time': robot_time(), **(arguments or {})}
    return GroupAction(
        [_include(package, name, given)], condition=IfCondition(LaunchConfiguration(argument))
    )


def _include(
    package: str, name: str, arguments: dict[str, Substitution] | None = None
) -> IncludeLaunchDescription:
    """Include a launch file of a package, which gets all arguments."""
    path = [FindPackageShare(package), 'launch', f'{name}.launch.py']
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(PathJoinSubstitution(path)),
        launch_arguments=(arguments or {}).items(),
    )
