# SPDX-License-Identifier: Apache-2.0
"""A process that does tasks for this one, may crash, and never outlives it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
import contextlib
from dataclasses import dataclass
import multiprocessing
from multiprocessing.connection import Connection
import os
import signal
import threading
import traceback
from typing import Any

from humanoid_simulation import processes

Work = Callable[[Any], Any]
"""Does a task; the process imports it by its module and name, or unpickles it."""


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
        self.connection, theirs = processes.CONTEXT.Pipe()
        self._process = processes.start(_serve, (theirs, work), environment)
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
            return Failure(f'its process {processes.ending_text(self._process)}')

    def end(self) -> None:
        """End the process."""
        self.connection.close()
        processes.end(self._process)


def _serve(connection: Connection, work: Work) -> None:
    """Do tasks until the connection is closed; the body of a worker process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all processes of a terminal
    processes.let_signals_through()
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
