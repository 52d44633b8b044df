# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 launch`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import os

from ros2cli.command import CommandExtension
from ros2launch.command.options import add_launch_options, prefix_arguments

SHOW_ALL_OUTPUT = 'OVERRIDE_LAUNCH_PROCESS_OUTPUT'


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
        add_launch_options(parser)

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
        from ros2launch.api.deferral import import_asyncio

        import_asyncio()
        from ros2launch.api.running import launch_a_launch_file
        from ros2launch.command.target import find_target

        prefix = prefix_arguments(args)
        if args.json and not args.dry_run:
            raise RuntimeError('--json says how --dry-run shows it: give both')
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
    from ros2launch.api.rehearsing import rehearse_launch_file

    return rehearse_launch_file(
        launch_file_path=path,
        launch_file_arguments=arguments,
        as_json=args.json,
        **_common(args),
    )


def _show(path: str, args: argparse.Namespace) -> int | str | None:
    from launch import InvalidLaunchFileError
    from launch._failure_place import place_of
    from launch.logging import launch_config
    from ros2launch.api.showing import print_a_launch_file, print_arguments_of_launch_file

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
