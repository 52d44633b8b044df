# SPDX-License-Identifier: Apache-2.0
"""Launch descriptions that spawn controllers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

__all__ = [
    'generate_controllers_spawner_launch_description',
    'generate_controllers_spawner_launch_description_from_dict',
    'generate_load_controller_launch_description',
]


def generate_controllers_spawner_launch_description(
    controller_names: Sequence[str],
    controller_params_files: Sequence[str] | None = None,
    extra_spawner_args: Sequence[Any] = (),
) -> LaunchDescription:
    """
    Describe a spawner of controllers.

    Its launch arguments are controller_manager_name and unload_on_kill.

    Parameters
    ----------
    controller_names
        The names of the controllers.
    controller_params_files
        The paths of files with their parameters.
    extra_spawner_args
        Further arguments of the spawner, such as `--load-only`.

    """
    names, files = list(controller_names), list(controller_params_files or ())
    return _description(names, [(names, files)], extra_spawner_args)


def generate_controllers_spawner_launch_description_from_dict(
    controller_info_dict: Mapping[str, str | Sequence[str] | None],
    extra_spawner_args: Sequence[Any] = (),
) -> LaunchDescription:
    """
    Describe spawners of controllers that have parameter files of their own.

    Parameters
    ----------
    controller_info_dict
        The path, or the paths, of files with parameters, by the names of the controllers; None for
        a controller without one.
    extra_spawner_args
        Further arguments of the spawners.

    """
    groups: dict[tuple[str, ...], list[str]] = {}
    for name, paths in controller_info_dict.items():
        files = (paths,) if isinstance(paths, str) else tuple(paths or ())
        groups.setdefault(files, []).append(name)
    parts = [(names, list(files)) for files, names in groups.items()]
    return _description(list(controller_info_dict), parts, extra_spawner_args)


def generate_load_controller_launch_description(
    controller_name: str,
    controller_params_file: str | Sequence[str] | None = None,
    extra_spawner_args: Sequence[Any] = (),
) -> LaunchDescription:
    """
    Describe a spawner of one controller.

    Parameters
    ----------
    controller_name
        The name of the controller.
    controller_params_file
        The path, or the paths, of files with its parameters.
    extra_spawner_args
        Further arguments of the spawner.

    """
    return generate_controllers_spawner_launch_description_from_dict(
        {controller_name: controller_params_file}, extra_spawner_args
    )


def _description(
    names: list[str], parts: Sequence[tuple[list[str], list[str]]], extra: Sequence[Any]
) -> LaunchDescription:
    if not names:
        raise ValueError('Name at least one controller.')
    unloads = LaunchConfiguration('unload_on_kill')
    spawners = [
        Node(
            package='controller_manager',
            executable='spawner',
            arguments=[
                *controllers,
                *('--controller-manager', LaunchConfiguration('controller_manager_name')),
                *(word for file in files for word in ('--param-file', file)),
                *extra,
                *options,
            ],
            condition=condition(unloads),
            output='screen',
        )
        for controllers, files in parts
        for condition, options in ((IfCondition, ['--unload-on-kill']), (UnlessCondition, []))
    ]
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                'controller_manager_name',
                default_value='controller_manager',
                description='Name of the controller manager.',
            ),
            DeclareLaunchArgument(
                'unload_on_kill',
                default_value='false',
                description='Wait until the launch ends, and then unload the controllers.',
            ),
            *spawners,
        ]
    )
