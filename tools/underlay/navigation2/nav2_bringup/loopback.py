# SPDX-License-Identifier: Apache-2.0
"""Start navigation with a robot in the loopback simulator."""

from __future__ import annotations

from typing import Any

from launch import LaunchDescription, LaunchDescriptionEntity
from launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    SetLaunchConfiguration,
)
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, PushROSNamespace
from launch_ros.substitutions import FindPackageShare
from nav2_bringup.servers import (
    configured_parameters,
    declared,
    REMAPPINGS,
    Server,
    server_actions,
)

__all__ = ['loopback_description']

_SHARE = FindPackageShare('nav2_bringup')
_MAP_SERVER = Server('nav2_map_server', 'map_server', 'nav2_map_server::MapServer', 'map_server')
_NAMES = (
    'namespace',
    'use_namespace',
    'map',
    'params_file',
    'autostart',
    'use_composition',
    'use_respawn',
    'log_level',
)
_PASSED_ON = tuple(name for name in _NAMES if name != 'map')


def loopback_description(map_file: str, scan_frame: str) -> LaunchDescription:
    """
    Describe a launch of navigation with a map, a simulated robot and RViz.

    Parameters
    ----------
    map_file
        The default map, of those that the package has.
    scan_frame
        The frame of the robot's laser scanner.

    """
    arguments = declared(*_NAMES, map=PathJoinSubstitution([_SHARE, 'maps', map_file]))
    more: dict[str, tuple[Any, str]] = {
        'use_rviz': ('True', 'Whether to start RViz.'),
        'rviz_config_file': (
            PathJoinSubstitution([_SHARE, 'rviz', 'nav2_default_view.rviz']),
            'Full path to the RViz configuration file.',
        ),
        'use_robot_state_pub': (
            'True',
            'Whether to publish the transforms from base_footprint to the laser scanner.',
        ),
    }
    arguments += [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, (default, description) in more.items()
    ]
    bringup = _include('bringup', use_localization='False', use_sim_time='true')
    rviz = _include(
        'rviz',
        condition=IfCondition(LaunchConfiguration('use_rviz')),
        rviz_config=LaunchConfiguration('rviz_config_file'),
        use_sim_time='true',
    )
    return LaunchDescription([*arguments, _robot_and_map(scan_frame), bringup, rviz])


def _robot_and_map(scan_frame: str) -> GroupAction:
    """Start the simulator, the static transforms of the robot, and the map server."""
    yaml_filename = 'map_server.ros__parameters.yaml_filename'
    manager = 'lifecycle_manager_map_server'
    return GroupAction(
        [
            PushROSNamespace(
                LaunchConfiguration('namespace'),
                condition=IfCondition(LaunchConfiguration('use_namespace')),
            ),
            Node(
                package='nav2_loopback_sim',
                executable='loopback_simulator',
                name='loopback_simulator',
                output='screen',
                parameters=[configured_parameters(), {'scan_frame_id': scan_frame}],
                remappings=REMAPPINGS,
            ),
            _static_transform('base_footprint', 'base_link'),
            _static_transform('base_link', scan_frame),
            SetLaunchConfiguration('use_composition', 'False'),
            SetLaunchConfiguration('use_sim_time', 'true'),
            *server_actions([_MAP_SERVER], manager, {yaml_filename: LaunchConfiguration('map')}),
        ]
    )


def _static_transform(parent: str, child: str) -> Node:
    return Node(
        package='tf2_ros',
        executable='static_transform_publisher',
        name=f'{parent}_to_{child}',
        arguments=['--frame-id', parent, '--child-frame-id', child],
        remappings=REMAPPINGS,
        condition=IfCondition(LaunchConfiguration('use_robot_state_pub')),
    )


def _include(name: str, condition: Any = None, **arguments: Any) -> LaunchDescriptionEntity:
    passed = {each: LaunchConfiguration(each) for each in _PASSED_ON}
    return IncludeLaunchDescription(
        PythonLaunchDescriptionSource(
            PathJoinSubstitution([_SHARE, 'launch', f'{name}_launch.py'])
        ),
        condition=condition,
        launch_arguments={**passed, **arguments}.items(),
    )
