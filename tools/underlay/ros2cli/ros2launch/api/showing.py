# SPDX-License-Identifier: Apache-2.0
"""Show a launch file without starting it: its arguments, its description, or a dry run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout
from io import StringIO
import os
import sys
from typing import Any

HEADER = "Arguments (pass arguments as '<name>:=<value>'):"
FOOTNOTE = '* argument(s) which are only used if specific conditions occur'
DRY_RUN_HEADER = """\
Nothing is started; this is what would be. To find out, the commands in
Command substitutions were run and the functions in launch files were called.
"""


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

    from ros2launch.api.running import LaunchOptions, make_service

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
