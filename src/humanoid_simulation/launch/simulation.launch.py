# SPDX-License-Identifier: Apache-2.0
"""Start the humanoid in a simulated world."""

from __future__ import annotations

from humanoid_simulation.files import SceneChoices
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe the node; it is where the time of /clock comes from."""
    config = [FindPackageShare('humanoid_simulation'), 'config', 'simulator.yaml']
    given = {
        name: ParameterValue(LaunchConfiguration(name), value_type=kind)
        for name, kind in (
            ('scene', str),
            ('real_time_factor', float),
            ('start_paused', bool),
            ('scale', float),
            ('prefix', str),
            ('hands', bool),
        )
    }
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'scene',
                default_value='flat',
                choices=SceneChoices(),
                description='What is in the world besides the robot.',
            ),
            DeclareLaunchArgument(
                'real_time_factor',
                default_value='1.0',
                description='Seconds of the world in a real one; 0 is as fast as possible.',
            ),
            DeclareLaunchArgument(
                'start_paused',
                default_value='false',
                choices=['true', 'false'],
                description='Wait for the service set_simulation_state before any time passes.',
            ),
            DeclareLaunchArgument(
                'scale', default_value='1.0', description='Size of the humanoid, 0.5 to 1.3.'
            ),
            DeclareLaunchArgument(
                'prefix',
                default_value='',
                description='What the names of all links and joints begin with.',
            ),
            DeclareLaunchArgument(
                'hands',
                default_value='false',
                choices=['true', 'false'],
                description='Give the arms wrists and grippers.',
            ),
            Node(
                package='humanoid_simulation',
                executable='simulator',
                output='screen',
                parameters=[PathJoinSubstitution(config), given],
            ),
        ]
    )
