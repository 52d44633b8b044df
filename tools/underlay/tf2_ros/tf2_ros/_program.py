# SPDX-License-Identifier: Apache-2.0
"""The body of the programs for transforms."""

from __future__ import annotations

from collections.abc import Callable
import os
import signal
import sys
import threading
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rclpy.executors import Executor
    from rclpy.node import Node

ArgumentsT = TypeVar('ArgumentsT')
_STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM)


def run(parse: Callable[[list[str]], ArgumentsT], work: Callable[[ArgumentsT], int | None]) -> int:
    """
    Do the work of a program; return the exit status.

    SIGINT and SIGTERM are blocked from here to the end, so that they interrupt nothing; `spin`
    waits for them.

    :param parse: makes the work's arguments of the words that are not for ROS
    :param work: runs while ROS does; may return an exit status
    """
    signal.pthread_sigmask(signal.SIG_BLOCK, _STOP_SIGNALS)
    import rclpy
    from rclpy.signals import SignalHandlerOptions
    from rclpy.utilities import remove_ros_args

    try:
        arguments = parse(list(remove_ros_args(sys.argv))[1:])
        rclpy.init(args=sys.argv, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        sys.stderr.write(
            f'The ROS arguments cannot be used: {error}. Correct what follows --ros-args.\n'
        )
        return 1
    try:
        return work(arguments) or 0
    finally:
        rclpy.try_shutdown()


def spin(node: Node, timeout_s: float | None = None) -> bool:
    """Let a node work until a signal to stop, or so long; return whether a signal came."""
    from rclpy.executors import SingleThreadedExecutor

    executor = SingleThreadedExecutor()
    executor.add_node(node)
    failures: list[Exception] = []
    thread = threading.Thread(target=_work, args=(executor, failures), name='node')
    thread.start()
    is_stopped = _wait_for_signal(timeout_s)
    executor.shutdown()
    thread.join()
    if failures:
        raise failures[0]
    return is_stopped


def _wait_for_signal(timeout_s: float | None) -> bool:
    if timeout_s is None:
        signal.sigwait(_STOP_SIGNALS)
        return True
    return signal.sigtimedwait(_STOP_SIGNALS, timeout_s) is not None


def _work(executor: Executor, failures: list[Exception]) -> None:
    """Let nodes work; a failure is for the main thread to raise."""
    try:
        executor.spin()
    except Exception as error:
        failures.append(error)
        os.kill(os.getpid(), signal.SIGTERM)
