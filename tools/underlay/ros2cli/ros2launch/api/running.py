# SPDX-License-Identifier: Apache-2.0
"""Run a launch file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ros2launch.api.arguments import misspelt_argument_text, parse_launch_arguments


def launch_a_launch_file(
    *,
    launch_file_path: str,
    launch_file_arguments: Sequence[str],
    noninteractive: bool = False,
    debug: bool = False,
    check_names: bool = True,
    prefork: bool = True,
) -> int:
    """Run a launch file until everything that it started has ended; return the status."""
    arguments = parse_launch_arguments(launch_file_arguments)
    from launch import LaunchDescription, LaunchService
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    source = AnyLaunchDescriptionSource(launch_file_path)
    if check_names and arguments:
        _check_names([name for name, _ in arguments], source)
    service = LaunchService(
        argv=list(launch_file_arguments),
        noninteractive=noninteractive,
        debug=debug,
        prefork=prefork,
    )
    service.include_launch_description(
        LaunchDescription([IncludeLaunchDescription(source, launch_arguments=arguments)])
    )
    status: int = service.run()
    return status


def _check_names(given: list[str], source: Any) -> None:
    """Raise a RuntimeError if an argument's name looks misspelt, before anything starts."""
    text = misspelt_argument_text(given, _declared_names(source))
    if text:
        raise RuntimeError(text)


def _declared_names(source: Any) -> list[str]:
    """
    Return the arguments of a launch file; none if it cannot be loaded.

    Whatever keeps the file from being loaded is reported when the launch service loads it.
    """
    description = source.try_get_launch_description_without_context()
    if description is None:
        return []
    return [argument.name for argument in description.get_launch_arguments()]
