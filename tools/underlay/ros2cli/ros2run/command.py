# SPDX-License-Identifier: Apache-2.0
"""The command `ros2 run`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from ros2cli.command import CommandExtension


class RunCommand(CommandExtension):
    """Run a package specific executable."""

    def add_arguments(
        self, parser: argparse.ArgumentParser, cli_name: str, *, argv: Sequence[str] | None = None
    ) -> None:
        """
        Add the arguments of `ros2 run`; everything after the executable's name is passed on to it.

        Parameters
        ----------
        parser
            The parser of the command.
        cli_name, argv
            The command line up to the command, `ros2 run`, and the arguments after it; unused.

        """
        parser.add_argument(
            '--prefix',
            type=_split,
            help='Prefix command, which should go before the '
            "executable, e.g. --prefix 'gdb -ex run --args'",
        )
        parser.add_argument('package_name', help='Name of the ROS package')
        parser.add_argument('executable_name', help='Name of the executable')
        parser.add_argument(
            'argv', nargs=argparse.REMAINDER, help='Pass arbitrary arguments to the executable'
        )

    def main(
        self, *, parser: argparse.ArgumentParser, args: argparse.Namespace
    ) -> int | str | None:
        """
        Find the executable and run it until it exits.

        Parameters
        ----------
        parser
            The parser of the command; unused.
        args : argparse.Namespace
            The parsed arguments.

        Returns
        -------
        int or str or None
            The exit status of the executable, negative after a signal, or the error message.

        """
        from ros2pkg.api import missing_package_by_name, PackageNotFoundError
        from ros2run.api import get_executable_path, MultipleExecutables, run_executable

        try:
            path = get_executable_path(
                package_name=args.package_name, executable_name=args.executable_name
            )
        except PackageNotFoundError:
            return missing_package_by_name(args.package_name)
        except MultipleExecutables as error:
            return ''.join(['Multiple executables found:', *(f'\n- {p}' for p in error.paths)])
        if path is None:
            return _no_executable(args.package_name, args.executable_name)
        status = run_executable(path=path, argv=args.argv, prefix=args.prefix)
        _report(status)
        return status


def _split(text: str) -> list[str]:
    """Split a command into words; raise ArgumentTypeError with the reason if that fails."""
    import shlex

    try:
        return shlex.split(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f'{text!r} is not a valid command: {error}') from error


def _report(status: int) -> None:
    if status > 0:
        print(f'[ros2run]: Process exited with failure {status}')
    elif status < 0:
        import signal

        print(f'[ros2run]: {signal.strsignal(-status)}')


def _no_executable(package: str, executable: str) -> str:
    from ros2pkg.api import get_package_prefix
    from ros_environment.workspace import explain_missing_executable

    advice = explain_missing_executable(package, executable, get_package_prefix(package))
    return '\n'.join(['No executable found', advice]).rstrip()
