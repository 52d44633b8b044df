# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 launch` and its options."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import os
import sys

from ros2cli.command import CommandExtension

SHOW_ALL_OUTPUT = 'OVERRIDE_LAUNCH_PROCESS_OUTPUT'
WHOLE_MODULES = ('inspect', 'linecache', 'ssl', 'textwrap')
"""Modules that asyncio and logging import, but use only for errors."""


class LaunchCommand(CommandExtension):
    """Run a launch file."""

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the options, the launch file and its arguments.

        Parameters
        ----------
        parser
            The parser of the command.
        cli_name, argv
            The command line up to the command, and the arguments after it; unused.

        """
        _add_launch_options(parser)

    def main(
        self, *, parser: argparse.ArgumentParser, args: argparse.Namespace
    ) -> int | str | None:
        """
        Run the launch file, or show what it would do or which arguments it has.

        Parameters
        ----------
        parser
            The parser of the command; unused.
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        int or str or None
            The exit status, or the error message of a file that cannot be shown.

        Raises
        ------
        RuntimeError
            There is no such launch file, an argument is malformed, or options conflict.

        """
        _import_asyncio()
        from ros2launch.api.arguments import find_target
        from ros2launch.api.running import launch_a_launch_file

        prefix = _prefix_arguments(args)
        if args.json and not args.dry_run:
            raise RuntimeError('--json requires --dry-run')
        path, arguments = find_target(
            args.package_name, args.launch_file_name, args.launch_arguments
        )
        if args.show_all_subprocesses_output:
            os.environ[SHOW_ALL_OUTPUT] = 'both'
        if args.show_args or args.print:
            return _show(path, args)
        if args.dry_run:
            return _rehearse(path, arguments + prefix, args)
        return launch_a_launch_file(
            launch_file_path=path,
            launch_file_arguments=arguments + prefix,
            noninteractive=args.noninteractive,
            debug=args.debug,
            strict_exit=args.strict_exit,
            prefork=not args.no_prefork,
            **_common(args),
        )


def _common(args: argparse.Namespace) -> dict[str, bool]:
    """Return the options that also apply to a dry run."""
    return {
        'check_names': not args.allow_unknown_args,
        'resolve_programs': not args.no_preflight,
        'scoped_location': args.scoped_location,
    }


def _rehearse(path: str, arguments: list[str], args: argparse.Namespace) -> int:
    from ros2launch.api.running import rehearse_launch_file

    return rehearse_launch_file(
        launch_file_path=path,
        launch_file_arguments=arguments,
        as_json=args.json,
        **_common(args),
    )


def _show(path: str, args: argparse.Namespace) -> int | str | None:
    from launch import InvalidLaunchFileError
    from launch.failures import place_of
    from launch.logging import launch_config
    from ros2launch.api.running import print_a_launch_file, print_arguments_of_launch_file

    launch_config.log_dir  # noqa: B018  # a run of its own, even if nothing is logged
    show = print_a_launch_file if args.print else print_arguments_of_launch_file
    try:
        show(launch_file_path=path)
    except InvalidLaunchFileError as error:
        if args.debug:
            raise
        text = f"the launch file '{path}' cannot be loaded (-d shows the traceback): {error}"
        return '\n'.join([text, *map(str, filter(None, [place_of(error)]))])
    return 0


def _add_launch_options(parser: argparse.ArgumentParser) -> None:
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
        help='Accept arguments that no launch file declares, without a warning',
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
        help='Start what is available, even if some programs are missing',
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


def _prefix_arguments(args: argparse.Namespace) -> list[str]:
    """Convert --launch-prefix and --launch-prefix-filter, if given, to `name:=value`."""
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


def _import_asyncio() -> None:
    """
    Import asyncio, unless it is imported already, without the modules that a launch does not need.

    asyncio imports all that it may ever use; TLS, signature inspection and traceback formatting
    take a third of the startup time of a launch. Here these modules are executed when one of their
    names is first used, which hardly ever happens in a launch.
    """
    if 'asyncio' in sys.modules:
        return
    from importlib.machinery import PathFinder

    from ros2cli.deferral import defer, defer_found

    package = PathFinder.find_spec('asyncio')
    if package is None:
        return
    defer(*WHOLE_MODULES)
    tls = defer_found(PathFinder.find_spec('asyncio.sslproto', package.submodule_search_locations))
    import asyncio

    if tls is not None:
        asyncio.sslproto = tls  # type: ignore[attr-defined]  # as importing it would do
