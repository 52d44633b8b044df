# SPDX-License-Identifier: Apache-2.0
"""The body of programs that are nodes: they end well on SIGINT and SIGTERM."""

from __future__ import annotations

from collections.abc import Callable, Sequence
import errno
import os
import signal
import sys
import threading
import time
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.task import Future

__all__ = ['run', 'run_node', 'spin', 'wait_for_signal']

ArgumentsT = TypeVar('ArgumentsT')
STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM)
_LOOK_S = 1.0
_END_S = 3.0
BROKEN_PIPE_STATUS = 128 + signal.SIGPIPE


def run_node(
    make_node: Callable[[list[str]], Node], arguments: Sequence[str] | None = None
) -> int:
    """
    Run the node that is made from the arguments without those for ROS; return the exit status.

    A ValueError while the node is made, or a parameter that ROS refuses, is one message on
    stderr and status 1.
    """

    def work(words: list[str]) -> int:
        from rclpy.exceptions import ParameterException

        try:
            node = make_node(words)
        except (ValueError, ParameterException) as error:
            sys.stderr.write(f'{error}\n')
            return 1
        spin(node)
        node.destroy_node()
        return 0

    return run(list, work, arguments)


def run(
    parse: Callable[[list[str]], ArgumentsT],
    work: Callable[[ArgumentsT], int | None],
    arguments: Sequence[str] | None = None,
) -> int:
    """
    Do the work of a program; return the exit status.

    SIGINT and SIGTERM are blocked from here to the end of the process, so that they interrupt
    nothing; `spin` waits for them. A thread that is older, as those of numpy, may get them all
    the same, and hands them over.

    :param parse: makes the work's arguments of the words that are not for ROS
    :param work: runs while ROS does; may return an exit status
    :param arguments: the command line with the program's name; by default that of the process
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOP_SIGNALS)
    _handle(_hand_over)
    try:
        return _run(parse, work, list(sys.argv if arguments is None else arguments))
    finally:
        # Who is impatient sends several, and the process has nothing left to do but to end.
        _handle(signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _handle(handler: Callable[[int, object], None] | signal.Handlers) -> None:
    for number in STOP_SIGNALS:
        signal.signal(number, handler)


def _hand_over(number: int, _: object) -> None:
    """Send a signal that another thread has got to the main thread, which waits for it."""
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
    """Say why ROS cannot be used, and what to do."""
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
    """Drop what nobody reads or no disk has room for; raise other errors again."""
    if error.errno not in (errno.EPIPE, errno.ENOSPC):
        raise error
    # The interpreter would try once more at the end, and complain.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if error.errno == errno.EPIPE:
        return BROKEN_PIPE_STATUS
    sys.stderr.write(f'The output cannot be written: {error.strerror}\n')
    return 1


def spin(node: Node, timeout_s: float | None = None) -> bool:
    """
    Let a node work until a signal to stop, or so long; return whether a signal came.

    With it work its `companions`, if it has any: further nodes that it has made for itself. It
    works in a thread of its own, so that the signals are heard whatever it does. A callback
    that does not return within some seconds is not waited for: the process ends.
    """
    from rclpy.task import Future
    from tf2_ros._clock_watch import watch_clock

    watch_clock(node)
    stop: Future[None] = Future()
    failures: list[Exception] = []
    thread = threading.Thread(target=_work, args=(node, stop, failures), name='node', daemon=True)
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
    """End the process although a callback runs; nothing else could end that."""
    sys.stderr.write(
        f"The node '{node.get_name()}' was busy in a callback for {_END_S:g} s after the signal "
        'to stop, and was ended.\n'
    )
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(1)


def wait_for_signal(timeout_s: float | None) -> bool:
    """Return whether a signal to stop came in time."""
    # Now and then a look for one that another thread has got.
    end_s = None if timeout_s is None else time.monotonic() + timeout_s
    left_s = _LOOK_S
    while left_s > 0.0:
        left_s = _LOOK_S if end_s is None else end_s - time.monotonic()
        if signal.sigtimedwait(STOP_SIGNALS, min(max(left_s, 0.0), _LOOK_S)) is not None:
            return True
    return False


def _work(node: Node, stop: Future[None], failures: list[Exception]) -> None:
    """Let a node work; a failure is for the main thread to raise."""
    from tf2_ros._executing import make_executor, spin_until

    executor = make_executor()
    for each in (node, *getattr(node, 'companions', ())):
        executor.add_node(each)
    try:
        spin_until(executor, stop)
    except Exception as error:
        failures.append(error)
        os.kill(os.getpid(), signal.SIGTERM)
    finally:
        executor.shutdown()
