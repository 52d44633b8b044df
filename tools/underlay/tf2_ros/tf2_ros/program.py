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
    Run a program whose work is to spin one node.

    A ValueError while the node is made, or a parameter that ROS rejects, is one message on stderr
    and status 1.

    Parameters
    ----------
    make_node
        Creates the node from the command line without the arguments for ROS.
    arguments : Sequence[str] | None
        The command line with the program's name; by default that of the process.

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
    Run the work of a program between the start and the shutdown of ROS.

    SIGINT and SIGTERM are blocked while the work runs, so that they interrupt nothing (`spin`
    waits for them), and ignored afterwards. A thread that is older, as those of numpy, may get
    them all the same, and hands them over.

    Parameters
    ----------
    parse
        Makes the arguments of `work` from the words that are not for ROS.
    work
        Runs while ROS does; may return an exit status.
    arguments : Sequence[str] | None
        The command line with the program's name; by default that of the process.

    Returns
    -------
    int
        The exit status: that of `work`, 0 if it returns None, 1 if ROS cannot be started or the
        disk is full, 141 if nobody reads the output any longer.

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
    Spin a node in a thread of its own until SIGINT, SIGTERM or a timeout.

    Its `companions`, further nodes that it has made for itself, are spun with it, if it has any. A
    callback that does not return within 3 s after the end is not waited for: the process exits
    with status 1.

    Parameters
    ----------
    node
        What is spun; an error in one of its callbacks ends spinning, and is raised here.
    timeout_s
        Longest time to spin, in s; by default there is no limit.

    Returns
    -------
    bool
        Whether a signal to stop has come.

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
    """
    Wait for SIGINT or SIGTERM, which `run` has blocked.

    Parameters
    ----------
    timeout_s
        Longest time to wait, in s; 0 only looks, None waits without limit.

    Returns
    -------
    bool
        Whether a signal has come in time.

    """
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
