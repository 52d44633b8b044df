# SPDX-License-Identifier: Apache-2.0
"""Start navigation servers and their manager, in a container or in processes of their own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from launch import LaunchDescriptionEntity
from launch.actions import DeclareLaunchArgument, GroupAction, SetEnvironmentVariable
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import LoadComposableNodes, Node, SetParameter
from launch_ros.descriptions import ComposableNode, ParameterFile
from launch_ros.substitutions import FindPackageShare
from nav2_common.launch import RewrittenYaml

__all__ = ['REMAPPINGS', 'Server', 'configured_parameters', 'declared', 'server_actions']

REMAPPINGS = [('/tf', 'tf'), ('/tf_static', 'tf_static')]
"""Each robot with a namespace has its own transform topics."""

DESCRIPTIONS = {
    'namespace': ('', 'Top-level namespace.'),
    'use_namespace': ('false', 'Whether to apply a namespace to the navigation stack.'),
    'slam': ('False', 'Whether to make a map (SLAM) instead of using one.'),
    'map': ('', 'Full path to the YAML file of the map to load.'),
    'use_localization': ('True', 'Whether to localise the robot in a map, or with SLAM.'),
    'use_sim_time': ('false', 'Take the time from /clock instead of the computer.'),
    'params_file': (
        PathJoinSubstitution([FindPackageShare('nav2_bringup'), 'params', 'nav2_params.yaml']),
        'Full path to the parameter file for all launched nodes.',
    ),
    'autostart': ('true', 'Bring the nodes up at once.'),
    'use_composition': ('True', 'Whether all nodes share one process.'),
    'container_name': (
        'nav2_container',
        'Name of the container that nodes are loaded into if use_composition is true.',
    ),
    'use_respawn': ('False', 'Whether to restart a process that has ended.'),
    'log_level': ('info', 'Log level.'),
}
"""Default and description of each argument of the launch files."""


class Server(NamedTuple):
    """A navigation server: its executable and its component."""

    package: str
    executable: str
    plugin: str
    name: str
    remappings: Sequence[tuple[str, str]] = ()


def declared(*names: str, **defaults: Any) -> list[LaunchDescriptionEntity]:
    """
    Declare arguments of a launch file.

    Parameters
    ----------
    *names
        The arguments, by their names in `DESCRIPTIONS`.
    **defaults
        Default values in place of those in `DESCRIPTIONS`.

    Returns
    -------
    list of LaunchDescriptionEntity
        One declaration for each, after an action that lets processes buffer their output.

    """
    actions: list[LaunchDescriptionEntity] = [
        SetEnvironmentVariable('RCUTILS_LOGGING_BUFFERED_STREAM', '1')
    ]
    for name in names:
        default, description = DESCRIPTIONS[name]
        actions.append(
            DeclareLaunchArgument(
                name, default_value=defaults.get(name, default), description=description
            )
        )
    return actions


def configured_parameters(**rewrites: Any) -> ParameterFile:
    """
    Rewrite the parameter file that the launch argument `params_file` names.

    Parameters
    ----------
    **rewrites
        New values by the names or whole paths of parameters, as for `RewrittenYaml`.

    Returns
    -------
    ParameterFile
        A copy of the file below the launch argument `namespace`, with its substitutions performed.

    """
    values: dict[Any, Any] = rewrites
    return ParameterFile(
        RewrittenYaml(
            source_file=LaunchConfiguration('params_file'),
            root_key=LaunchConfiguration('namespace'),
            param_rewrites=values,
            convert_types=True,
        ),
        allow_substs=True,
    )


def server_actions(
    servers: Sequence[Server], manager: str, rewrites: dict[str, Any] | None = None
) -> list[LaunchDescriptionEntity]:
    """
    Make the actions that start servers and their lifecycle manager.

    Parameters
    ----------
    servers
        The servers, in the order in which they are brought up.
    manager
        The name of the lifecycle manager.
    rewrites
        Further values that override the parameter file, by their paths.

    """
    parameters = configured_parameters(
        autostart=LaunchConfiguration('autostart'), **(rewrites or {})
    )
    managed = {
        'autostart': LaunchConfiguration('autostart'),
        'node_names': [server.name for server in servers],
    }
    package = 'nav2_lifecycle_manager'
    server_of_manager = Server(
        package, 'lifecycle_manager', 'nav2_lifecycle_manager::LifecycleManager', manager
    )
    told: list[tuple[Server, list[Any]]] = [(server, [parameters]) for server in servers]
    told.append((server_of_manager, [managed]))
    separate = GroupAction(
        [SetParameter('use_sim_time', LaunchConfiguration('use_sim_time'))]
        + [_program(server, values) for server, values in told],
        condition=UnlessCondition(LaunchConfiguration('use_composition')),
    )
    composed = GroupAction(
        [
            SetParameter('use_sim_time', LaunchConfiguration('use_sim_time')),
            LoadComposableNodes(
                target_container=[
                    LaunchConfiguration('namespace'),
                    '/',
                    LaunchConfiguration('container_name'),
                ],
                composable_node_descriptions=[
                    ComposableNode(
                        package=server.package,
                        plugin=server.plugin,
                        name=server.name,
                        parameters=values,
                        remappings=[*REMAPPINGS, *server.remappings],
                    )
                    for server, values in told
                ],
            ),
        ],
        condition=IfCondition(LaunchConfiguration('use_composition')),
    )
    return [separate, composed]


def _program(server: Server, parameters: list[Any]) -> Node:
    return Node(
        package=server.package,
        executable=server.executable,
        name=server.name,
        output='screen',
        respawn=LaunchConfiguration('use_respawn'),
        respawn_delay=2.0,
        parameters=parameters,
        arguments=['--ros-args', '--log-level', LaunchConfiguration('log_level')],
        remappings=[*REMAPPINGS, *server.remappings],
    )
