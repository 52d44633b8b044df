# SPDX-License-Identifier: Apache-2.0
"""Start the humanoid: everything that there is."""

from __future__ import annotations

from humanoid_bringup.launch_arguments import is_simulated, robot_time
from humanoid_bringup.robot_watch import announce_start, watch_robot
from launch import LaunchDescription, Substitution
from launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    RegisterEventHandler,
)
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import (
    EqualsSubstitution,
    LaunchConfiguration,
    PathJoinSubstitution,
)
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Compose the launch files of the packages."""
    backend, simulated, time = LaunchConfiguration('backend'), is_simulated(), robot_time()
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'backend',
                default_value='mujoco',
                choices=['mujoco', 'mock'],
                description='The robot: a simulator with physics, or a mock without.',
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
                description='Use the time of the topic /clock instead of the system clock; auto '
                'does so with the simulator.',
            ),
            DeclareLaunchArgument(
                'gui',
                default_value='true',
                choices=['true', 'false'],
                description='Show the robot in RViz, with panels to drive and monitor it.',
            ),
            DeclareLaunchArgument(
                'qr_code',
                default_value='auto',
                choices=['auto', 'true', 'false'],
                description='Print the address of the page as a QR code as well, if other '
                'machines can reach it; auto does so in a terminal.',
            ),
            DeclareLaunchArgument(
                'navigation',
                default_value='false',
                choices=['true', 'false'],
                description='Start Nav2, to navigate with a map or to make one.',
            ),
            DeclareLaunchArgument(
                'perception',
                default_value='false',
                choices=['true', 'false'],
                description='Detect objects, remember where they are, and look for them.',
            ),
            DeclareLaunchArgument(
                'manipulation',
                default_value='false',
                choices=['true', 'false'],
                description='Let the arms reach for objects; the robot needs hands:=true.',
            ),
            DeclareLaunchArgument(
                'report_period_s',
                default_value='3600.0',
                description='How often the sensor processor logs the first joint, in seconds.',
            ),
            DeclareLaunchArgument(
                'when_robot_ends',
                default_value='shutdown',
                choices=['shutdown', 'stay'],
                description='What the other nodes do when the simulator or the mock robot exits.',
            ),
            RegisterEventHandler(watch_robot('when_robot_ends')),
            RegisterEventHandler(
                announce_start(has_page=True), condition=IfCondition(LaunchConfiguration('gui'))
            ),
            RegisterEventHandler(
                announce_start(has_page=False),
                condition=UnlessCondition(LaunchConfiguration('gui')),
            ),
            # First what checks its arguments: nothing starts with a scene that does not exist.
            _group('humanoid_simulation', 'simulation', time, simulated),
            _group('humanoid_control', 'mock_robot', time, EqualsSubstitution(backend, 'mock')),
            _group('humanoid_control', 'robot_bringup', time),
            _group('humanoid_description', 'description', time),
            _group('humanoid_navigation', 'navigation', time, LaunchConfiguration('navigation')),
            _group('humanoid_perception', 'perception', time, LaunchConfiguration('perception')),
            _group(
                'humanoid_manipulation', 'manipulation', time, LaunchConfiguration('manipulation')
            ),
            _group('humanoid_bringup', 'console', time, LaunchConfiguration('gui')),
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
