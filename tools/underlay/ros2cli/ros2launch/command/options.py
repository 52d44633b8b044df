# SPDX-License-Identifier: Apache-2.0
"""The options and arguments of `ros2 launch`."""

from __future__ import annotations

import argparse
import sys


def add_launch_options(parser: argparse.ArgumentParser) -> None:
    """
    Add all options, then the launch file and its arguments.

    Parameters
    ----------
    parser
        The parser of the command.

    """
    add = parser.add_argument
    add(
        '-n',
        '--noninteractive',
        action='store_true',
        default=not (sys.stdin and sys.stdin.isatty()),
        help='Run the launch system non-interactively, with no terminal associated',
    )
    add(
        '-d',
        '--debug',
        action='store_true',
        help='Put the launch system in debug mode, provides more verbose output',
    )
    add_either = parser.add_mutually_exclusive_group().add_argument
    add_either(
        '-p',
        '--print',
        '--print-description',
        action='store_true',
        help='Print the launch description to the console without launching it',
    )
    add_either(
        '-s',
        '--show-args',
        '--show-arguments',
        action='store_true',
        help='Show arguments that may be given to the launch file',
    )
    add(
        '-a',
        '--show-all-subprocesses-output',
        action='store_true',
        help="Show all launched subprocesses' output by overriding their output configuration",
    )
    add(
        '--allow-unknown-args',
        action='store_true',
        help='Accept arguments that no launch file declares, without a word',
    )
    add(
        '--dry-run',
        action='store_true',
        help='Show what would be started, with arguments, parameters and conditions',
    )
    add('--json', action='store_true', help='With --dry-run: show it as JSON')
    add(
        '--no-preflight',
        action='store_true',
        help='Start what there is, also if some programs are missing',
    )
    add(
        '--scoped-location',
        action='store_true',
        help='Let ThisLaunchFileDir() and $(dirname) stand for the including file again after '
        'an include',
    )
    add(
        '--strict-exit',
        action='store_true',
        help='Exit with the status of the first process that failed',
    )
    add(
        '--no-prefork',
        action='store_true',
        help='Start every Python node from scratch, not as a copy of a process that is ready',
    )
    _add_prefix_options(parser)
    _add_positionals(parser)


def prefix_arguments(args: argparse.Namespace) -> list[str]:
    """
    Convert the options --launch-prefix and --launch-prefix-filter to launch arguments.

    Parameters
    ----------
    args : argparse.Namespace
        The parsed arguments with these options.

    Returns
    -------
    list of str
        Launch arguments as `name:=value`, for the options that were given.

    Raises
    ------
    RuntimeError
        A filter was given without a prefix.

    """
    if args.launch_prefix_filter is not None and args.launch_prefix is None:
        raise RuntimeError(
            '--launch-prefix must be specified if --launch-prefix-filter is provided'
        )
    values = {
        'launch-prefix': args.launch_prefix,
        'launch-prefix-filter': args.launch_prefix_filter,
    }
    return [f'{name}:={value}' for name, value in values.items() if value is not None]


def _add_prefix_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        '--launch-prefix',
        metavar='COMMAND',
        help='Prefix command, which should go before all executables, e.g. '
        "--launch-prefix 'xterm -e gdb -ex run --args'",
    )
    parser.add_argument(
        '--launch-prefix-filter',
        metavar='REGEX',
        help='Regex pattern for filtering which executables the --launch-prefix is applied to',
    )


def _add_positionals(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'package_name',
        help='Name of the ROS package which contains the '
        'launch file, or the path of a launch file',
    )
    parser.add_argument('launch_file_name', nargs='?', help='Name of the launch file')
    parser.add_argument(
        'launch_arguments',
        nargs='*',
        help="Arguments to the launch file; '<name>:=<value>' (for duplicates, last one wins)",
    )
