# SPDX-License-Identifier: Apache-2.0
"""
Entry point of the `ros2` command line.

The commands of the underlay are in a static table, so that no entry points are scanned.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
import io
import os
import sys

from ros2cli.entry import add_lazy_subparsers, Entry
from ros2cli.exit_status import run_to_status
from ros2cli.parser import Parser
from ros2cli.start_up import end, open_standard_streams

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import NoReturn  # noqa: I300

COMPLETION_VARIABLE = '_ARGCOMPLETE'
COMMAND_GROUP = 'ros2cli.command'
COMMANDS = {
    'action': Entry('ros2cli.commands:ActionCommand', 'Various action related sub-commands'),
    'bag': Entry('ros2cli.commands:BagCommand', 'Various rosbag related sub-commands'),
    'component': Entry(
        'ros2cli.commands:ComponentCommand',
        'Various component related sub-commands',
    ),
    # In a package of its own, as in a ROS installation, but in the table so that help lists it.
    'control': Entry(
        'ros2controlcli.command.control:ControlCommand', 'Various control related sub-commands'
    ),
    'daemon': Entry('ros2cli.commands:DaemonCommand', 'Various daemon related sub-commands'),
    'doctor': Entry(
        'ros2doctor.command:DoctorCommand', 'Check ROS setup and other potential issues'
    ),
    'extension_points': Entry(
        'ros2cli.extensions:ExtensionPointsCommand',
        'List extension points',
        hidden=True,
    ),
    'extensions': Entry('ros2cli.extensions:ExtensionsCommand', 'List extensions', hidden=True),
    'interface': Entry(
        'ros2cli.commands:InterfaceCommand', 'Show information about ROS interfaces'
    ),
    'launch': Entry('ros2launch.command.launch:LaunchCommand', 'Run a launch file'),
    'lifecycle': Entry(
        'ros2cli.commands:LifecycleCommand',
        'Various lifecycle related sub-commands',
    ),
    'multicast': Entry(
        'ros2cli.commands:MulticastCommand',
        'Various multicast related sub-commands',
    ),
    'node': Entry('ros2cli.commands:NodeCommand', 'Various node related sub-commands'),
    'param': Entry('ros2cli.commands:ParamCommand', 'Various param related sub-commands'),
    'pkg': Entry('ros2cli.commands:PkgCommand', 'Various package related sub-commands'),
    'run': Entry('ros2run.command:RunCommand', 'Run a package specific executable'),
    'service': Entry('ros2cli.commands:ServiceCommand', 'Various service related sub-commands'),
    'topic': Entry('ros2cli.commands:TopicCommand', 'Various topic related sub-commands'),
    'wtf': Entry('ros2doctor.command:WtfCommand', 'Use `wtf` as alias to `doctor`'),
}


def run() -> NoReturn:
    """Run the command of this process and exit; Ctrl-C does not disturb the exit."""
    status = main()
    signals = sys.modules.get('signal')
    if signals is not None:  # without it, no loaded module takes time at exit
        signals.signal(signals.SIGINT, signals.SIG_IGN)
    end(status)


def main(argv: Sequence[str] | None = None) -> int:
    """
    Run one `ros2` command and return its exit status.

    Parameters
    ----------
    argv
        The arguments after `ros2`; those of this process if None.

    """
    words = list(sys.argv[1:] if argv is None else argv)
    open_standard_streams()
    if COMPLETION_VARIABLE in os.environ:
        return run_to_status(_complete)
    return run_to_status(lambda: _run_command(words))


def _complete() -> None:
    from ros2cli.completion import answer

    answer(lambda words: create_parser(words, argparse.ArgumentParser))


def _run_command(argv: list[str]) -> int | str | None:
    parser = create_parser(argv)
    args = parser.parse_args(argv)
    if not args.use_python_default_buffering and isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(line_buffering=True)
    command = getattr(args, '_command', None)
    if command is None:
        parser.print_help()
        return 0
    status: int | str | None = command.main(parser=parser, args=args)
    return status


def create_parser(
    argv: Sequence[str], parser_class: type[argparse.ArgumentParser] = Parser
) -> argparse.ArgumentParser:
    """
    Build the root parser, complete for the command that is called.

    Parameters
    ----------
    argv
        The arguments after `ros2`, which name the command.
    parser_class
        The class of the parser and of all its subparsers.

    Raises
    ------
    SystemExit
        There is no such command or verb.

    """
    parser = parser_class(
        prog='ros2',
        description='ros2 is an extensible command-line tool for ROS 2.',
    )
    parser.add_argument(
        '--use-python-default-buffering',
        action='store_true',
        help='use the output buffering of Python instead of line buffering',
    )
    add_lazy_subparsers(
        parser,
        'ros2',
        entries=COMMANDS,
        group=COMMAND_GROUP,
        kind='command',
        dest='_command',
        argv=argv,
    )
    return parser
