# SPDX-License-Identifier: Apache-2.0
"""A process that does tasks for this one, may crash, and never outlives it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
import contextlib
from dataclasses import dataclass
import multiprocessing
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from multiprocessing.resource_tracker import ensure_running
import os
import signal
import threading
import traceback
from typing import Any

Work = Callable[[Any], Any]
"""Does a task; the process imports it by its module and name, or unpickles it."""
_PATIENCE_S = 2.0
_ENDING = {signal.SIGINT, signal.SIGTERM}


@dataclass(frozen=True)
class Failure:
    """A task was not done: its process has ended, or the work has raised an exception."""

    reason: str
    """How the process ended, or the traceback."""


class WorkerProcess:
    """
    A process that does one task at a time; it ends with this one, even if this one is killed.

    Parameters
    ----------
    work
        Does a task.
    environment
        Environment variables of the process, in addition to those of this one.

    Attributes
    ----------
    connection
        Ready to be read once there is an outcome.
    has_ended
        Whether the process has ended by itself, which an outcome has shown.

    """

    def __init__(self, work: Work, environment: Mapping[str, str]) -> None:
        context = multiprocessing.get_context('spawn')
        self.connection, theirs = context.Pipe()
        self._process: BaseProcess = context.Process(
            target=_serve, args=(theirs, work), daemon=True
        )
        with _environment(environment), _uninterrupted():
            self._process.start()
        theirs.close()
        self.has_ended = False

    def start(self, task: Any) -> None:
        """
        Start a task; the process is idle.

        Parameters
        ----------
        task
            What the work is called with.

        """
        # If the process has ended, `outcome` says so.
        with contextlib.suppress(OSError):
            self.connection.send(task)

    def outcome(self) -> Any:
        """Read the result of the task, or a `Failure`, once the connection is ready."""
        try:
            return self.connection.recv()
        except (EOFError, OSError):
            self.has_ended = True
            self._process.join(_PATIENCE_S)
            return Failure(_ending(self._process.exitcode))

    def end(self) -> None:
        """End the process."""
        self.connection.close()
        self._process.terminate()
        self._process.join(_PATIENCE_S)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()


@contextlib.contextmanager
def _environment(variables: Mapping[str, str]) -> Iterator[None]:
    """Set environment variables while a process starts."""
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextlib.contextmanager
def _uninterrupted() -> Iterator[None]:
    """Defer Ctrl-C and SIGTERM while a process starts: one that half starts leaves a traceback."""
    ensure_running()  # when Python starts this process of its own, it lets all signals through
    arrived: list[int] = []
    handlers = {
        number: signal.signal(number, lambda number, frame: arrived.append(number))
        for number in _ENDING
    }
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, _ENDING)  # the new process has it, too
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for taken in arrived:
            signal.raise_signal(taken)


def _ending(exit_code: int | None) -> str:
    """Describe how a process ended."""
    if exit_code is not None and exit_code < 0:
        return f'its process was ended by {signal.Signals(-exit_code).name}'
    return f'its process ended with status {exit_code}'


def _serve(connection: Connection, work: Work) -> None:
    """Do tasks until the connection is closed; the body of a worker process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all processes of a terminal
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDING)  # see _uninterrupted
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with contextlib.suppress(EOFError, OSError):
        while True:
            task = connection.recv()
            try:
                outcome = work(task)
            except Exception:
                outcome = Failure(traceback.format_exc().strip())
            connection.send(outcome)


def _end_with_parent() -> None:
    """End this process as soon as its parent has ended, however that was."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
