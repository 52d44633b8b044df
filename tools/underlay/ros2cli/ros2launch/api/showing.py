# SPDX-License-Identifier: Apache-2.0
"""Show the arguments that a launch file declares."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import redirect_stdout
from io import StringIO
from typing import Any

HEADER = "Arguments (pass arguments as '<name>:=<value>'):"
FOOTNOTE = '* argument(s) which are only used if specific conditions occur'


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
    if any(map(_is_conditional, arguments)):
        yield from ('', FOOTNOTE)


def _lines_of(argument: Any) -> Iterator[str]:
    mark = '*' if _is_conditional(argument) else ''
    yield ''
    yield f"    '{argument.name}':{mark}"
    yield f'        {argument.description}'
    if argument.default_value is not None:
        parts = ' + '.join(part.describe() for part in argument.default_value)
        yield f'        (default: {parts})'


def _is_conditional(argument: Any) -> bool:
    return bool(getattr(argument, '_conditionally_included', False))
