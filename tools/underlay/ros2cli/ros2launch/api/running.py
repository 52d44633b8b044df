# SPDX-License-Identifier: Apache-2.0
"""Run a launch file, rehearse it, or show its arguments or its description."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout
from dataclasses import dataclass
from io import StringIO
import os
import sys
from typing import Any

from ros2launch.api.arguments import parse_launch_arguments, UnknownArguments

HEADER = "Arguments (pass arguments as '<name>:=<value>'):"
FOOTNOTE = '* argument(s) which are only used if specific conditions occur'
DRY_RUN_HEADER = """\
Dry run: nothing is started. To determine what would be, the commands in Command
substitutions were run and the functions in launch files were called.
"""


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


def rehearse_launch_file(
    *,
    launch_file_path: str,
    launch_file_arguments: Sequence[str],
    as_json: bool,
    **options: bool,
) -> int:
    """
    Print what a launch file would do (a dry run).

    No process of the launch is started, but command substitutions are run, and functions in
    launch files are called.

    Parameters
    ----------
    launch_file_path
        The path of the launch file.
    launch_file_arguments
        Launch arguments as `name:=value`.
    as_json
        Whether to print JSON, even on failure; all other output then goes to stderr.
    **options
        Fields of `LaunchOptions`, other than `noninteractive`.

    Returns
    -------
    int
        The exit status: 0, or 1 if the file cannot be launched.

    Raises
    ------
    RuntimeError
        A launch argument is malformed.

    """
    import json

    service = make_service(
        launch_file_path, launch_file_arguments, LaunchOptions(**options, noninteractive=True)
    )
    from launch.dry_run import rehearse

    with _output_to_stderr() if as_json else nullcontext():
        root, status = rehearse(service)
    if as_json:
        print(json.dumps({'status': status, **root.as_data()}, indent=2, default=_plain))
    elif status == 0:
        _print_tree(root)
    return status


@contextmanager
def _output_to_stderr() -> Iterator[None]:
    """Redirect standard output to stderr, including that of functions and child processes."""
    with redirect_stdout(sys.stderr):
        if sys.__stdout__ is None or sys.__stderr__ is None:
            yield
            return
        sys.__stdout__.flush()
        kept = os.dup(1)
        os.dup2(2, 1)
        try:
            yield
        finally:
            os.dup2(kept, 1)
            os.close(kept)


def _print_tree(root: Any) -> None:
    from launch.dry_run_record import tree_lines

    print(DRY_RUN_HEADER)
    print('\n'.join(tree_lines(root)))


def _plain(value: Any) -> Any:
    """Convert a value that is not JSON-serializable."""
    return value.decode('utf-8', 'replace') if isinstance(value, bytes) else str(value)


def print_arguments_of_launch_file(*, launch_file_path: str) -> None:
    """
    Load a launch file and print its arguments, and those of the files that it includes.

    What the files themselves print while they are loaded comes below the heading.

    Parameters
    ----------
    launch_file_path
        The path of the launch file.

    Raises
    ------
    FileNotFoundError
        There is no such file.
    InvalidLaunchFileError
        It cannot be loaded; what it printed until then has been printed.

    """
    printed = StringIO()
    try:
        with redirect_stdout(printed):
            lines = list(argument_lines(load_launch_file(launch_file_path).get_launch_arguments()))
    except BaseException:
        print(printed.getvalue(), end='')
        raise
    print(HEADER)
    print(printed.getvalue(), end='')
    print('\n'.join(lines))


def print_a_launch_file(*, launch_file_path: str) -> None:
    """
    Load a launch file and print its launch description as a tree.

    Parameters
    ----------
    launch_file_path
        The path of the launch file.

    Raises
    ------
    FileNotFoundError
        There is no such file.
    InvalidLaunchFileError
        It cannot be loaded.

    """
    from launch import LaunchIntrospector

    print(LaunchIntrospector().format_launch_description(load_launch_file(launch_file_path)))


def load_launch_file(path: str) -> Any:
    """
    Load the launch description of a launch file, without visiting it.

    Parameters
    ----------
    path
        The path of the launch file, in any format.

    Returns
    -------
    LaunchDescription
        The description.

    Raises
    ------
    FileNotFoundError
        There is no such file.
    InvalidLaunchFileError
        It cannot be loaded.

    """
    from launch import LaunchContext
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    return AnyLaunchDescriptionSource(path).get_launch_description(LaunchContext())


def argument_lines(arguments: list[Any]) -> Iterator[str]:
    """
    Format the launch arguments with their descriptions and default values.

    Parameters
    ----------
    arguments : list[Any]
        The `DeclareLaunchArgument` actions that `get_launch_arguments` of a description lists.

    Yields
    ------
    str
        The lines to print below the heading.

    """
    if not arguments:
        yield from ('', '  No arguments.')
    for argument in arguments:
        yield from _lines_of(argument)
    if any(argument.is_conditional for argument in arguments):
        yield from ('', FOOTNOTE)


def _lines_of(argument: Any) -> Iterator[str]:
    mark = '*' if argument.is_conditional else ''
    yield ''
    yield f"    '{argument.name}':{mark}"
    yield f'        {argument.description}'
    if argument.default_value is not None:
        parts = ' + '.join(part.describe() for part in argument.default_value)
        yield f'        (default: {parts})'
