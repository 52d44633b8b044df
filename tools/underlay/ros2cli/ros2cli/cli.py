# SPDX-License-Identifier: Apache-2.0
"""
Entry point of the `ros2` command line: from its arguments to the exit status.

The commands of the underlay are in a static table, so that no entry points are scanned.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
import errno
import io
import os
import sys

from ros2cli.entry import add_lazy_subparsers, Entry
from ros2cli.parser import Parser
from ros2cli.start_up import end, open_standard_streams

TYPE_CHECKING = False

if TYPE_CHECKING:
    from typing import NoReturn  # noqa: I300

BROKEN_PIPE_STATUS = 128 + 13  # status that shells report for SIGPIPE
INTERRUPT_STATUS = 2  # the number of SIGINT
TERMINATION_STATUS = 15  # the number of SIGTERM
COMPLETION_VARIABLE = '_ARGCOMPLETE'
COMMAND_GROUP = 'ros2cli.command'
CHOSEN_COMMAND = 'chosen_command'  # attribute of the parsed arguments
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
    command = getattr(args, CHOSEN_COMMAND, None)
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
        dest=CHOSEN_COMMAND,
        argv=argv,
    )
    return parser


def run_to_status(call: Callable[[], int | str | None]) -> int:
    """
    Call a command and translate its result, or its exception, to an exit status.

    Errors that a user can fix (RuntimeError), signals, closed pipes and full disks are handled;
    other exceptions propagate.

    Parameters
    ----------
    call
        The command; it returns a status, an error message or None.

    Returns
    -------
    int
        The exit status of the process.

    """
    try:
        status = _call_or_exit(call)
        _flush()
        return status
    except KeyboardInterrupt:
        return _after_interrupt()
    except Exception as error:
        status_of_error = _status_of(error)
        if status_of_error is None:
            raise
        return status_of_error


def _status_of(error: Exception) -> int | None:
    """Return the exit status for an exception; None if it is unexpected."""
    if isinstance(error, BrokenPipeError):
        return _after_broken_pipe()
    if _comes_from_interrupt(error):
        return _after_interrupt()
    if isinstance(error, OSError) and error.errno == errno.ENOSPC:
        return _after_full_disk(error)
    if isinstance(error, RuntimeError):
        return _to_status(str(error) or type(error).__name__)
    return TERMINATION_STATUS if _is_external_shutdown(error) else None


def _comes_from_interrupt(error: BaseException | None) -> bool:
    """Whether Ctrl-C caused an error, as it does during the import of rclpy's C library."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _after_interrupt() -> int:
    """Ignore a second Ctrl-C during shutdown."""
    import signal
    import warnings

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # An interrupt may leave a coroutine of rclpy behind that is never awaited.
    warnings.simplefilter('ignore', RuntimeWarning)
    return INTERRUPT_STATUS


def _call_or_exit(call: Callable[[], int | str | None]) -> int:
    """Call a command; catch the SystemExit of argparse, since output has yet to be flushed."""
    try:
        return _to_status(call())
    except SystemExit as end:
        return _to_status(end.code)


def _is_external_shutdown(error: BaseException) -> bool:
    """
    Whether an exception is rclpy's ExternalShutdownException; this does not import rclpy.

    Parameters
    ----------
    error
        Any exception.

    """
    executors = sys.modules.get('rclpy.executors')
    return executors is not None and isinstance(error, executors.ExternalShutdownException)


def _to_status(result: int | str | None) -> int:
    if isinstance(result, str):
        _flush()
        print(result, file=sys.stderr)
        return 1
    return result or 0


def _flush() -> None:
    """Flush a stream, unless the command has closed it."""
    if not sys.stdout.closed:
        sys.stdout.flush()


def _after_full_disk(error: OSError) -> int:
    """Report that the output cannot be written, and discard the rest."""
    _after_broken_pipe()
    return _to_status(f'The output cannot be written: {error.strerror}')


def _after_broken_pipe() -> int:
    """Redirect stdout to /dev/null, so that the interpreter can flush it without an error."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return BROKEN_PIPE_STATUS
