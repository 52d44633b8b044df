# SPDX-License-Identifier: Apache-2.0
"""Main functions of ROS programs: their arguments, and a clean end on SIGINT and SIGTERM."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
import errno
from functools import partial
from math import nan
import os
import signal
import sys
import threading
import time
from typing import Any, TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.task import Future

__all__ = ['number_in', 'run', 'run_node', 'spin', 'wait_for_signal']

ArgumentsT = TypeVar('ArgumentsT')
NodeT = TypeVar('NodeT', bound='Node')
STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM)
_LOOK_S = 1.0
_END_S = 3.0
BROKEN_PIPE_STATUS = 128 + signal.SIGPIPE

_CLOCK_S = 5.0
_CLOCK = '/clock'


def run_node(
    make_node: Callable[[list[str]], NodeT],
    arguments: Sequence[str] | None = None,
    task: Callable[[NodeT], Coroutine[Any, Any, object]] | None = None,
) -> int:
    """
    Run a program that spins a single node.

    A ValueError from creating the node, or a parameter that ROS rejects, results in one message on
    stderr and exit status 1.

    Parameters
    ----------
    make_node
        Creates the node from the command line without ROS arguments.
    arguments : Sequence[str] | None
        The command line including the program name; by default that of the process.
    task
        A coroutine function that gets the node; the program ends when it has returned.

    Returns
    -------
    int
        The exit status.

    """

    def work(words: list[str]) -> int:
        from rclpy.exceptions import ParameterException

        try:
            node = make_node(words)
        except (ValueError, ParameterException) as error:
            sys.stderr.write(f'{error}\n')
            return 1
        spin(node, task=partial(task, node) if task else None)
        node.destroy_node()
        return 0

    return run(list, work, arguments)


def run(
    parse: Callable[[list[str]], ArgumentsT],
    work: Callable[[ArgumentsT], int | None],
    arguments: Sequence[str] | None = None,
) -> int:
    """
    Run the work of a program between the initialisation and the shutdown of ROS.

    SIGINT and SIGTERM are blocked while the work runs, so that they interrupt nothing (`spin`
    waits for them), and ignored afterwards. Threads created earlier, such as those of numpy, may
    still receive them; they are forwarded to the main thread.

    Parameters
    ----------
    parse
        Parses the command line without ROS arguments into the argument of `work`.
    work
        Called while ROS is initialised; may return an exit status.
    arguments : Sequence[str] | None
        The command line including the program name; by default that of the process.

    Returns
    -------
    int
        The exit status: that of `work`, 0 if it returns None, 1 if ROS cannot be initialised or
        the disk is full, 141 for a broken pipe on the standard output.

    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOP_SIGNALS)
    _handle(_hand_over)
    try:
        return _run(parse, work, list(sys.argv if arguments is None else arguments))
    finally:
        # Further signals are ignored, as the process is about to exit anyway.
        _handle(signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _handle(handler: Callable[[int, object], None] | signal.Handlers) -> None:
    for number in STOP_SIGNALS:
        signal.signal(number, handler)


def _hand_over(number: int, _: object) -> None:
    """Forward a signal received by another thread to the main thread, which waits for it."""
    signal.pthread_kill(threading.main_thread().ident or 0, number)


def _run(
    parse: Callable[[list[str]], ArgumentsT],
    work: Callable[[ArgumentsT], int | None],
    words: list[str],
) -> int:
    import rclpy
    from rclpy.signals import SignalHandlerOptions
    from rclpy.utilities import remove_ros_args

    try:
        parsed = parse(list(remove_ros_args(words))[1:])
        rclpy.init(args=words, signal_handler_options=SignalHandlerOptions.NO)
    except RuntimeError as error:
        sys.stderr.write(f'{_reason(error)}\n')
        return 1
    try:
        return work(parsed) or 0
    except OSError as error:
        return _status_of_lost_output(error)
    finally:
        rclpy.try_shutdown()


def _reason(error: RuntimeError) -> str:
    """Explain why ROS cannot be initialised, with advice."""
    if 'initialize logging' in str(error):
        return (
            f'The log cannot be written: {error}. Set ROS_LOG_DIR, or HOME, to a folder that can '
            'be written.'
        )
    return (
        f'The ROS arguments cannot be used: {error}. '
        'Correct what follows --ros-args, or the parameter file that it names.'
    )


def _status_of_lost_output(error: OSError) -> int:
    """Return the exit status after a broken pipe or a full disk; re-raise other errors."""
    if error.errno not in (errno.EPIPE, errno.ENOSPC):
        raise error
    # Otherwise the interpreter would flush again at exit, and report another error.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if error.errno == errno.EPIPE:
        return BROKEN_PIPE_STATUS
    sys.stderr.write(f'The output cannot be written: {error.strerror}\n')
    return 1


def spin(
    node: Node,
    timeout_s: float | None = None,
    task: Callable[[], Coroutine[Any, Any, object]] | None = None,
) -> bool:
    """
    Spin a node in its own thread until SIGINT, SIGTERM, a timeout or the end of a task.

    Its `companions`, if any (additional nodes that it created for itself), are spun as well. If a
    callback does not return within 3 s after the end, the process exits with status 1.

    Parameters
    ----------
    node
        The node to spin; an error in one of its callbacks ends spinning and is raised here.
    timeout_s
        The maximum time to spin, in s; unlimited by default.
    task
        A coroutine function that the node's executor runs; spinning ends when it has returned.

    Returns
    -------
    bool
        Whether it ended before the timeout, by a stop signal or with the task.

    """
    from rclpy.task import Future

    _watch_clock(node)
    stop: Future[None] = Future()
    failures: list[Exception] = []
    work = partial(_work, node, stop, failures, task)
    thread = threading.Thread(target=work, name='node', daemon=True)
    thread.start()
    is_stopped = wait_for_signal(timeout_s)
    stop.set_result(None)
    thread.join(_END_S)
    if thread.is_alive():
        _leave(node)
    if failures:
        raise failures[0]
    return is_stopped


def _leave(node: Node) -> None:
    """Exit the process while a callback is running, which cannot be ended otherwise."""
    sys.stderr.write(
        f"The node '{node.get_name()}' was still busy in a callback {_END_S:g} s after the stop "
        'signal, and was terminated.\n'
    )
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(1)


def wait_for_signal(timeout_s: float | None) -> bool:
    """
    Wait for SIGINT or SIGTERM, which `run` has blocked.

    Parameters
    ----------
    timeout_s
        The maximum time to wait, in s; 0 polls without blocking, None waits indefinitely.

    Returns
    -------
    bool
        Whether a signal was received in time.

    """
    # Wake up periodically to run the handler of a signal that another thread has received.
    end_s = None if timeout_s is None else time.monotonic() + timeout_s
    left_s = _LOOK_S
    while left_s > 0.0:
        left_s = _LOOK_S if end_s is None else end_s - time.monotonic()
        if signal.sigtimedwait(STOP_SIGNALS, min(max(left_s, 0.0), _LOOK_S)) is not None:
            return True
    return False


def _work(
    node: Node,
    stop: Future[None],
    failures: list[Exception],
    task: Callable[[], Coroutine[Any, Any, object]] | None,
) -> None:
    """Spin a node and its companions; an error is stored for the main thread to raise."""
    from tf2_ros.executing import make_executor, spin_until

    executor = make_executor()
    for each in (node, *getattr(node, 'companions', ())):
        executor.add_node(each)
    try:
        if task is not None:
            executor.create_task(task).add_done_callback(_wake_main_thread)
        spin_until(executor, stop)
    except Exception as error:
        failures.append(error)
        _wake_main_thread()
    finally:
        executor.shutdown()


def _wake_main_thread(_: object = None) -> None:
    """End `wait_for_signal`."""
    os.kill(os.getpid(), signal.SIGTERM)


def _watch_clock(node: Node) -> None:
    """
    Warn after 5 s if a node with `use_sim_time` has received no time on `/clock`.

    Parameters
    ----------
    node
        The node whose clock is checked; a timer is added to it if it follows `/clock`.

    """
    if not node.get_clock().ros_time_is_active:
        return
    from rclpy.clock import Clock, ClockType

    def look() -> None:
        timer.cancel()
        if node.get_clock().now().nanoseconds == 0:
            node.get_logger().warning(_complaint(node.count_publishers(_CLOCK)))

    timer = node.create_timer(_CLOCK_S, look, clock=Clock(clock_type=ClockType.STEADY_TIME))


def _complaint(publishers: int) -> str:
    why = (
        f'no time received on {_CLOCK} yet' if publishers else f'there is no publisher on {_CLOCK}'
    )
    return (
        f'use_sim_time is true, but {why}: the time of this node stands still. Start the '
        'simulator, or play the bag with --clock; without one, do not set use_sim_time.'
    )


def number_in(low: float, high: float, what: str) -> Callable[[str], float]:
    """
    Create an argparse type for numbers in a range.

    Parameters
    ----------
    low, high
        The range, including both limits.
    what
        Description of the number, with its unit, for the error message: 'rate in Hz'.

    Returns
    -------
    Callable
        Converts an argument to a number, or raises `argparse.ArgumentTypeError`.

    """

    def read(text: str) -> float:
        number = _number(text)
        if not low <= number <= high:
            from argparse import ArgumentTypeError

            raise ArgumentTypeError(
                f'{text!r} is not a {what}: give a number from {low:g} to {high:g}'
            )
        return number

    return read


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return nan
