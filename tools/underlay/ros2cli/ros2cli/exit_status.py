# SPDX-License-Identifier: Apache-2.0
"""Translation of the result or exception of a command to the exit status of the process."""

from __future__ import annotations

from collections.abc import Callable
import errno
import os
import sys

BROKEN_PIPE_STATUS = 128 + 13  # status that shells report for SIGPIPE
INTERRUPT_STATUS = 2  # the number of SIGINT
TERMINATION_STATUS = 15  # the number of SIGTERM


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
    return TERMINATION_STATUS if is_external_shutdown(error) else None


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


def is_external_shutdown(error: BaseException) -> bool:
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
