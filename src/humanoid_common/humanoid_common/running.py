# SPDX-License-Identifier: Apache-2.0
"""The body of every `main`: run a node until it is told to stop."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import sys
from typing import ParamSpec

from humanoid_common.errors import UserError
from humanoid_common.executing import destroy, make_executor, spin_until
from humanoid_common.interrupts import stop_on_signals, StopRequest
import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

NodeFactory = Callable[[], Node]
P = ParamSpec('P')
_ends: dict[Context, Future[None]] = {}
"""Futures that end the node that `run_node` runs, by its context."""
_PATIENCE_S = 5.0
_CLOCK = '/clock'


def run_node(factory: NodeFactory, args: Sequence[str] | None = None) -> int:
    """
    Run a node until it is told to stop, and return the exit status of the process.

    SIGINT and SIGTERM end the node between two callbacks, or while it starts, with status 0. A
    UserError, of the start or of a callback, ends it with status 1 and its message on stderr.

    Parameters
    ----------
    factory
        Creates the node, once ROS is initialised.
    args : Sequence[str] | None
        Command line arguments, including those for ROS; by default `sys.argv`.

    """
    with stop_on_signals() as stop:
        try:
            _initialize(args)
            _run(factory, stop)
        except (KeyboardInterrupt, ExternalShutdownException):
            return 0
        except (UserError, ParameterException) as error:
            sys.stderr.write(f'{error}\n')
            return 1
        finally:
            rclpy.try_shutdown()
    return 0


def ending(node: Node, callback: Callable[P, None]) -> Callable[P, None]:
    """
    Wrap a callback of a node so that it ends the node when it raises UserError.

    `run_node` then shows the message, and nothing else. In a node that is run otherwise, the error
    propagates.

    Parameters
    ----------
    node
        The node that the callback belongs to.
    callback
        The callback, with any arguments.

    """

    def call(*args: P.args, **kwargs: P.kwargs) -> None:
        end = _ends.get(node.context)
        if end is None:
            callback(*args, **kwargs)
        elif not end.done():
            try:
                callback(*args, **kwargs)
            except UserError as error:
                end.set_exception(error)

    return call


def _initialize(args: Sequence[str] | None) -> None:
    """
    Initialise rclpy; invalid ROS arguments end in a message instead of a traceback.

    rclpy installs no signal handlers: they would shut down the context under a running callback.
    """
    try:
        rclpy.init(
            args=None if args is None else list(args),
            signal_handler_options=SignalHandlerOptions.NO,
        )
    except RuntimeError as error:
        raise UserError(_refusal(str(error))) from error


def _refusal(reason: str) -> str:
    """Build the message about a failed initialisation, with what to do."""
    if 'initialize logging' in reason:
        return f'This node cannot write its log: {reason}. Set ROS_LOG_DIR to a writable folder.'
    return (
        f'The ROS arguments of this node cannot be used: {reason}. '
        'Correct what follows --ros-args, or the parameter file that it names.'
    )


def _made(factory: NodeFactory, stop: StopRequest) -> Node:
    """
    Create the node, which may take seconds; a stop request interrupts it.

    Code that a signal interrupts may turn KeyboardInterrupt into an error of its own.
    """
    stop.at_once = True
    try:
        return factory()
    except Exception as error:
        if stop.is_made:
            raise KeyboardInterrupt from error
        raise
    finally:
        stop.at_once = False


def _run(factory: NodeFactory, stop: StopRequest) -> None:
    """Create the node, run its callbacks until the stop request, and destroy it."""
    node = _made(factory, stop)
    _watch_clock(node)
    executor = make_executor()
    executor.add_node(node)
    done: Future[None] = Future()
    stop.wake_with(lambda: done.set_result(None))
    _ends[node.context] = done
    try:
        spin_until(executor, done)
        done.result()
    finally:
        del _ends[node.context]
        stop.wake_with(None)
        executor.shutdown()
        destroy(node)


def _watch_clock(node: Node) -> None:
    """
    Warn once if a node with `use_sim_time` receives no time from /clock.

    Parameters
    ----------
    node
        The node; it is checked once, `_PATIENCE_S` of real time from now.

    """
    if not node.get_clock().ros_time_is_active:
        return

    def look() -> None:
        timer.cancel()
        if node.get_clock().now().nanoseconds == 0:
            node.get_logger().warning(_missing_time_warning(node.count_publishers(_CLOCK)))

    timer = node.create_timer(_PATIENCE_S, look, clock=Clock(clock_type=ClockType.STEADY_TIME))


def _missing_time_warning(publishers: int) -> str:
    """
    Build the warning about missing simulated time.

    Parameters
    ----------
    publishers
        Number of publishers of /clock.

    """
    why = (
        f'no time received on {_CLOCK} yet' if publishers else f'there is no publisher on {_CLOCK}'
    )
    return (
        f'use_sim_time is true, but {why}: the time of this node stands still. Start the '
        'simulator, or play the bag with --clock; without one, do not set use_sim_time.'
    )
