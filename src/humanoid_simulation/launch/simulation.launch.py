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
                description='The scene around the robot.',
            ),
            DeclareLaunchArgument(
                'real_time_factor',
                default_value='1.0',
                description='Seconds of simulated time per real second; 0 is as fast as possible.',
            ),
            DeclareLaunchArgument(
                'start_paused',
                default_value='false',
                choices=['true', 'false'],
                description='Start paused, until the service set_simulation_state is called.',
            ),
            DeclareLaunchArgument(
                'scale', default_value='1.0', description='Size of the humanoid, 0.5 to 1.3.'
            ),
            DeclareLaunchArgument(
                'prefix',
                default_value='',
                description='Prefix of the names of all links and joints.',
            ),
            DeclareLaunchArgument(
                'hands',
                default_value='false',
                choices=['true', 'false'],
                description='Add wrists and grippers to the arms.',
            ),
            Node(
                package='humanoid_simulation',
                executable='simulator',
                output='screen',
                parameters=[PathJoinSubstitution(config), given],
            ),
        ]
    )
