# SPDX-License-Identifier: Apache-2.0
"""Run a launch file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ros2launch.api.arguments import parse_launch_arguments, UnknownArguments


@dataclass(frozen=True)
class LaunchOptions:
    """
    Options for running a launch.

    :param noninteractive: whether there is no user at a terminal
    :param debug: whether debug messages are logged
    :param check_names: whether arguments that no launch file declares are errors
    :param resolve_programs: whether all programs must exist before the first one starts
    :param prefork: whether Python nodes are forked from a prepared process
    :param scoped_location: whether the location of an include is scoped to it
    """

    noninteractive: bool = False
    debug: bool = False
    check_names: bool = True
    resolve_programs: bool = True
    prefork: bool = True
    scoped_location: bool = False


def launch_a_launch_file(
    *,
    launch_file_path: str,
    launch_file_arguments: Sequence[str],
    strict_exit: bool = False,
    **options: bool,
) -> int:
    """
    Run a launch file until all processes that it started have exited.

    Parameters
    ----------
    launch_file_path
        The path of the launch file.
    launch_file_arguments
        Launch arguments as `name:=value`.
    strict_exit
        Whether the exit status reflects failed processes.
    **options
        Fields of `LaunchOptions`.

    Returns
    -------
    int
        The exit status: 1 if an exception occurred in the launch, else 0; with `strict_exit`, that
        of the first process that failed (for a signal, 128 plus its number) instead of 0.

    Raises
    ------
    RuntimeError
        A launch argument is malformed, or this is not the main thread.

    """
    service = make_service(launch_file_path, launch_file_arguments, LaunchOptions(**options))
    status: int = service.run()
    if strict_exit and status == 0:
        return service.context.run.first_failure or 0
    return status


def make_service(path: str, argument_texts: Sequence[str], options: LaunchOptions) -> Any:
    """
    Create the launch service for a launch file, with its checks, ready to be run or rehearsed.

    Parameters
    ----------
    path
        The path of the launch file, which is loaded when the service runs.
    argument_texts
        Launch arguments as `name:=value`.
    options
        The options of the launch.

    Returns
    -------
    LaunchService
        The service.

    Raises
    ------
    RuntimeError
        A launch argument is malformed.

    """
    arguments = parse_launch_arguments(argument_texts)
    from launch import LaunchDescription, LaunchService
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    source = AnyLaunchDescriptionSource(path)
    service = LaunchService(
        argv=list(argument_texts),
        noninteractive=options.noninteractive,
        debug=options.debug,
        prefork=options.prefork,
    )
    service.include_launch_description(
        LaunchDescription([IncludeLaunchDescription(source, launch_arguments=arguments)])
    )
    service.context.run.scopes_location = options.scoped_location
    before_start: Any = service.context.run.before_start
    before_start.resolves_programs &= options.resolve_programs
    if options.check_names and arguments:
        _check_names([name for name, _ in arguments], source, before_start)
    return service


def _check_names(given: list[str], source: Any, before_start: Any) -> None:
    check = UnknownArguments(given, source)
    before_start.checks.append(check)
    before_start.hints.append(check.hint)
