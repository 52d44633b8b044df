# SPDX-License-Identifier: Apache-2.0
"""What the programs of this package share: their options, their node and their end."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
import signal
import sys

from controller_manager.controller_manager_services import ServiceNotFoundError
import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

__all__ = ['add_manager_arguments', 'node_of', 'parse', 'run']

INTERRUPTED_STATUS = 130


def add_manager_arguments(parser: argparse.ArgumentParser) -> None:
    """
    Add the options about the controller manager, and how long it is waited for.

    Parameters
    ----------
    parser
        The parser of a program.

    """
    parser.add_argument(
        '-c',
        '--controller-manager',
        default='controller_manager',
        help='name of the controller manager (default: %(default)s)',
    )
    parser.add_argument(
        '--controller-manager-timeout',
        metavar='S',
        type=_seconds,
        default=0.0,
        help='how long to wait for the controller manager, in s; 0 for no limit (default)',
    )
    parser.add_argument(
        '--switch-timeout',
        metavar='S',
        type=_seconds,
        default=5.0,
        help='how long a switch may take, in s (default: %(default)s)',
    )
    parser.add_argument(
        '--service-call-timeout',
        metavar='S',
        type=_seconds,
        default=10.0,
        help='how long to wait for an answer of the manager, in s (default: %(default)s)',
    )


def _seconds(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 <= value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a time in s')
    return value


def parse(parser: argparse.ArgumentParser, arguments: Sequence[str] | None) -> argparse.Namespace:
    """
    Parse a command line, in which arguments of ROS may stand.

    Parameters
    ----------
    parser
        The parser.
    arguments
        The command line, including the program name; by default that of the process.

    Returns
    -------
    argparse.Namespace
        The options; `words` is the whole command line.

    """
    words = list(sys.argv if arguments is None else arguments)
    args = parser.parse_args(remove_ros_args(words)[1:])
    args.words = words
    return args


@contextmanager
def node_of(name: str, words: Sequence[str]) -> Iterator[Node]:
    """
    Start ROS with a node, which SIGINT and SIGTERM interrupt with KeyboardInterrupt.

    The node can still call services after that.

    Parameters
    ----------
    name
        The name of the node, unless the command line has another.
    words
        The command line, including the program name.

    """
    rclpy.init(args=list(words), signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    node = Node(name)
    try:
        yield node
    finally:
        node.destroy_node()
        rclpy.shutdown()


def run(work: Callable[[], bool]) -> int:
    """
    Call the work of a program; errors become sentences.

    Parameters
    ----------
    work
        Returns whether it has done what was asked.

    Returns
    -------
    int
        The exit status: 0, 1 if it has failed, and 130 if it was interrupted.

    """
    try:
        return 0 if work() else 1
    except KeyboardInterrupt:
        return INTERRUPTED_STATUS
    except (RuntimeError, ServiceNotFoundError) as error:
        sys.stderr.write(f'{error}\n')
        return 1
