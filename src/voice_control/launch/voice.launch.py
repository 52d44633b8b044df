# SPDX-License-Identifier: Apache-2.0
"""Let the humanoid hear and speak: a microphone, a recogniser and a voice."""

from __future__ import annotations

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

ARGUMENTS = (
    ('microphone', '', 'Part of the name of the microphone; empty for the default device.'),
    ('wav_file', '', 'A WAV file to use instead of a microphone, with audio:=file.'),
    ('speech_model_path', '', 'The Whisper model on this machine: a folder, or a ggml file.'),
    ('speech_base_url', '', 'The base URL of a transcription server.'),
    ('speech_model', '', 'The model that this server should use.'),
    (
        'wake_word',
        '',
        'The wake word that commands have to start with; empty to accept every command.',
    ),
    ('namespace', '', 'The namespace of the robot.'),
    ('use_sim_time', 'false', 'Use the time of the topic /clock instead of the system clock.'),
)
CHOICES = (
    (
        'audio',
        'auto',
        ['auto', 'microphone', 'file', 'none'],
        'The audio source; auto is a microphone if there is one.',
    ),
    (
        'speech_backend',
        'pocketsphinx',
        ['pocketsphinx', 'whisper', 'whisper_cpp', 'openai'],
        'What recognizes speech: a grammar (pocketsphinx), Whisper, or a server (openai).',
    ),
)


def generate_launch_description() -> LaunchDescription:
    """Start the three nodes."""
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            *(
                DeclareLaunchArgument(
                    name, default_value=default, choices=choices, description=description
                )
                for name, default, choices, description in CHOICES
            ),
            _node('audio_source', source='audio', device='microphone', wav_file='wav_file'),
            _node(
                'speech_recognizer',
                backend='speech_backend',
                model_path='speech_model_path',
                base_url='speech_base_url',
                model='speech_model',
                wake_word='wake_word',
            ),
            _node('speaker'),
        ]
    )


def _node(name: str, **parameters: str) -> Node:
    """Describe a node of this package, which is started anew if it ends."""
    given = {
        parameter: ParameterValue(LaunchConfiguration(argument), value_type=str)
        for parameter, argument in parameters.items()
    }
    return Node(
        package='voice_control',
        executable=name,
        namespace=LaunchConfiguration('namespace'),
        output='screen',
        respawn=True,
        respawn_delay=2.0,
        parameters=[{'use_sim_time': LaunchConfiguration('use_sim_time'), **given}],
    )
