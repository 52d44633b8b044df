# SPDX-License-Identifier: Apache-2.0
"""Let the humanoid be told what to do: a planner, and what does its plans."""

from __future__ import annotations

from humanoid_perception.places_choice import places_choice
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = (
    ('skills_file', '', 'The skills file; empty for the one in this package.'),
    (
        'places_file',
        '',
        'Named places: a file, or the name of one in humanoid_perception; by default, that of '
        'the scene.',
    ),
    (
        'llm_base_url',
        'http://127.0.0.1:11434/v1',
        'The base URL of a language model server.',
    ),
    ('llm_model', '', 'The model to use; may be empty if the server has only one.'),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Use the time of the topic /clock instead of the system clock.'),
)
PLANNER = (
    ('backend', 'planner_backend'),
    ('base_url', 'llm_base_url'),
    ('model', 'llm_model'),
    ('confirm', 'confirm'),
)
"""Parameters of the planner, and the arguments that give them."""


def generate_launch_description() -> LaunchDescription:
    """Start the two nodes."""
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            DeclareLaunchArgument(
                'planner_backend',
                default_value='rules',
                choices=['rules', 'openai'],
                description='The planner: rules, or a language model (openai).',
            ),
            DeclareLaunchArgument(
                'confirm',
                default_value='never',
                choices=['never', 'motion', 'always'],
                description='Which plans have to be confirmed by a person.',
            ),
            _node('task_planner', {name: LaunchConfiguration(each) for name, each in PLANNER}),
            _node('skill_executor', {}),
        ]
    )


def _node(name: str, parameters: dict[str, object]) -> Node:
    """Describe a node of this package, which is started anew if it ends."""
    return Node(
        package='llm_planner',
        executable=name,
        namespace=LaunchConfiguration('namespace'),
        output='screen',
        respawn=True,
        respawn_delay=2.0,
        parameters=[
            {
                'skills_file': LaunchConfiguration('skills_file'),
                'places_file': places_choice(),
                'use_sim_time': LaunchConfiguration('use_sim_time'),
                **parameters,
            }
        ],
    )
