# SPDX-License-Identifier: Apache-2.0
"""From what a command returns or raises to the exit status of the process."""

from __future__ import annotations

from collections.abc import Callable
import errno
import os
import signal
import sys
import warnings

BROKEN_PIPE_STATUS = 128 + signal.SIGPIPE


def run_to_status(call: Callable[[], int | str | None]) -> int:
    """Call a command and translate its result, or its exception, to an exit status."""
    try:
        status = _call_or_exit(call)
        _flush()
        return status
    except BrokenPipeError:
        return _after_broken_pipe()
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        # Where rclpy is interrupted it may leave a coroutine behind that never starts.
        warnings.simplefilter('ignore', RuntimeWarning)
        return int(signal.SIGINT)
    except OSError as error:
        if error.errno != errno.ENOSPC:
            raise
        return _after_full_disk(error)
    except RuntimeError as error:
        return _to_status(str(error) or type(error).__name__)
    except Exception as error:
        if is_external_shutdown(error):
            return int(signal.SIGTERM)
        raise


def _call_or_exit(call: Callable[[], int | str | None]) -> int:
    """Call a command; argparse ends with SystemExit, whose output is still to be flushed."""
    try:
        return _to_status(call())
    except SystemExit as end:
        return _to_status(end.code)


def is_external_shutdown(error: BaseException) -> bool:
    """Tell if rclpy ended the work because of SIGTERM; rclpy is not imported for that."""
    executors = sys.modules.get('rclpy.executors')
    return executors is not None and isinstance(error, executors.ExternalShutdownException)


def _to_status(result: int | str | None) -> int:
    if isinstance(result, str):
        _flush()
        print(result, file=sys.stderr)
        return 1
    return result or 0


def _flush() -> None:
    """Write what is left, unless the command has closed the stream."""
    if not sys.stdout.closed:
        sys.stdout.flush()


def _after_full_disk(error: OSError) -> int:
    """Say that the output cannot be written, and drop what is left of it."""
    _after_broken_pipe()
    return _to_status(f'The output cannot be written: {error.strerror}')


def _after_broken_pipe() -> int:
    """Give stdout a place to flush to, so that the interpreter ends without a complaint."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return BROKEN_PIPE_STATUS
