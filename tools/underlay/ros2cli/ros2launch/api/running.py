# SPDX-License-Identifier: Apache-2.0
"""Run a launch file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ros2launch.api.arguments import parse_launch_arguments


def launch_a_launch_file(
    *,
    launch_file_path: str,
    launch_file_arguments: Sequence[str],
    noninteractive: bool = False,
    debug: bool = False,
    check_names: bool = True,
    resolve_programs: bool = True,
    strict_exit: bool = False,
    prefork: bool = True,
) -> int:
    """Run a launch file until everything that it started has ended; return the status."""
    service = make_service(
        launch_file_path,
        launch_file_arguments,
        noninteractive=noninteractive,
        debug=debug,
        check_names=check_names,
        resolve_programs=resolve_programs,
        prefork=prefork,
    )
    status: int = service.run()
    if strict_exit and status == 0:
        return service.context._first_failure or 0
    return status


def make_service(
    path: str,
    argument_texts: Sequence[str],
    *,
    noninteractive: bool,
    debug: bool,
    check_names: bool,
    resolve_programs: bool,
    prefork: bool = True,
) -> Any:
    """Return a launch service that is to visit a launch file, with its checks."""
    arguments = parse_launch_arguments(argument_texts)
    from launch import LaunchDescription, LaunchService
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    source = AnyLaunchDescriptionSource(path)
    service = LaunchService(
        argv=list(argument_texts), noninteractive=noninteractive, debug=debug, prefork=prefork
    )
    service.include_launch_description(
        LaunchDescription([IncludeLaunchDescription(source, launch_arguments=arguments)])
    )
    before_start: Any = service.context._before_start
    before_start.resolves_programs &= resolve_programs
    if check_names and arguments:
        _check_names([name for name, _ in arguments], source, before_start)
    return service


def _check_names(given: list[str], source: Any, before_start: Any) -> None:
    from ros2launch.api.unknown_arguments import UnknownArguments

    check = UnknownArguments(given, source)
    before_start.checks.append(check)
    before_start.hints.append(check.hint)
