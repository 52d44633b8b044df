# SPDX-License-Identifier: Apache-2.0
"""Run a node until SIGINT or SIGTERM comes, and end it well."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import signal
import sys

import rclpy
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

__all__ = ['run_node']

LATENCY_S = 0.2
"""A signal that comes while nothing else happens is noticed after so long at the latest."""


def run_node(
    make_node: Callable[[list[str]], Node], arguments: Sequence[str] | None = None
) -> int:
    """
    Run the node that is made from the arguments without those for ROS; return the exit status.

    Signals end it between two callbacks, with status 0. A ValueError while the node is made, or
    a parameter that ROS refuses, is one message on stderr and status 1.
    """
    signals = _Signals()
    words = list(sys.argv if arguments is None else arguments)
    try:
        _initialize(words)
        node = make_node(remove_ros_args(words)[1:])
    except (ValueError, ParameterException) as error:
        rclpy.try_shutdown()
        sys.stderr.write(f'{error}\n')
        return 1
    _spin(node, signals)
    return 0


def _initialize(words: list[str]) -> None:
    """Start ROS without its own handling of signals; ValueError if it refuses the arguments."""
    try:
        rclpy.init(args=words, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        raise ValueError(
            f'The ROS arguments cannot be used: {error}. '
            'Correct what follows --ros-args, or the parameter file that it names.'
        ) from error


class _Signals:
    """Takes note of SIGINT and SIGTERM, which interrupt nothing."""

    def __init__(self) -> None:
        self.came = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._note)

    def _note(self, number: int, frame: object) -> None:
        self.came = True


def _spin(node: Node, signals: _Signals) -> None:
    """Run callbacks until a signal has come, and destroy the node."""
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while rclpy.ok() and not signals.came:
            executor.spin_once(timeout_sec=LATENCY_S)
    except ExternalShutdownException:
        pass
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()
