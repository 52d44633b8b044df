# SPDX-License-Identifier: Apache-2.0
"""Start the humanoid: everything that there is."""

from __future__ import annotations

from humanoid_bringup.robot_watch import watch_robot
from launch import LaunchDescription, Substitution
from launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    RegisterEventHandler,
)
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (
    EqualsSubstitution,
    IfElseSubstitution,
    LaunchConfiguration,
    PathJoinSubstitution,
)
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Compose the launch files of the packages."""
    backend, given_time = LaunchConfiguration('backend'), LaunchConfiguration('use_sim_time')
    simulated = EqualsSubstitution(backend, 'mujoco')
    automatic = EqualsSubstitution(given_time, 'auto')
    time = IfElseSubstitution(automatic, simulated, given_time)
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'backend',
                default_value='mujoco',
                choices=['mujoco', 'mock'],
                description='What moves: a simulator with physics, or a mock without.',
            ),
            DeclareLaunchArgument(
                'use_controller',
                default_value='true',
                choices=['true', 'false'],
                description='Start the joint controller, which swings the arms.',
            ),
            DeclareLaunchArgument(
                'use_sim_time',
                default_value='auto',
                choices=['auto', 'true', 'false'],
                description='Take the time from the topic /clock instead of the computer; '
                'auto does so with the simulator.',
            ),
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show the robot in RViz, with what one drives and watches it with.',
            ),
            DeclareLaunchArgument(
                'when_robot_ends',
                default_value='shutdown',
                choices=['shutdown', 'stay'],
                description='What the rest does when the simulator or the mock robot ends.',
            ),
            RegisterEventHandler(watch_robot('when_robot_ends')),
            _group('humanoid_bringup', 'console', time, LaunchConfiguration('gui')),
            _group('humanoid_simulation', 'simulation', time, simulated),
            _group('humanoid_control', 'mock_robot', time, EqualsSubstitution(backend, 'mock')),
            _group('humanoid_control', 'robot_bringup', time),
            _group('humanoid_description', 'description', time),
        ]
    )


def _group(
    package: str, name: str, time: Substitution, condition: Substitution | str = 'true'
) -> GroupAction:
    """Include a launch file of a package, which gets all arguments, if a condition holds."""
    path = [FindPackageShare(package), 'launch', f'{name}.launch.py']
    include = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(PathJoinSubstitution(path)),
        launch_arguments={'use_sim_time': time}.items(),
    )
    return GroupAction([include], condition=IfCondition(condition))
