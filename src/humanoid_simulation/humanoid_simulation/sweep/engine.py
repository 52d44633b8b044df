# SPDX-License-Identifier: Apache-2.0
"""Do many runs in parallel: the interface of engines, and the one on this machine's cores."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
import contextlib
from dataclasses import dataclass
import multiprocessing
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnContext
from multiprocessing.process import BaseProcess
from multiprocessing.resource_tracker import ensure_running
import os
import signal
import threading
import traceback
from typing import Protocol, TYPE_CHECKING

from humanoid_simulation.sweep import ENVIRONMENT
from humanoid_simulation.sweep.results import RunResult

if TYPE_CHECKING:  # processes of tests need not import the walk
    from humanoid_simulation.sweep.conditions import Run

Work = Callable[['Run'], RunResult]
"""Does one run; other processes import it by its module and name."""
ATTEMPTS = 2
"""How often a run is tried whose process crashes."""
_PATIENCE_S = 2.0
_ENDING = {signal.SIGINT, signal.SIGTERM}


@dataclass(frozen=True)
class Done:
    """A run that is finished."""

    run: Run
    result: RunResult


@dataclass(frozen=True)
class Crashed:
    """An attempt at a run in which its process ended or failed."""

    run: Run
    attempt: int
    reason: str

    @property
    def is_final(self) -> bool:
        """Whether the run is not tried again."""
        return self.attempt >= ATTEMPTS


Outcomes = Generator[Done | Crashed, None, None]


class Engine(Protocol):
    """What does runs: each is done once, or tried `ATTEMPTS` times if its process crashes."""

    def outcomes(self, runs: Sequence[Run]) -> Outcomes:
        """
        Do the runs, and yield what becomes of each as soon as it is known, in any order.

        Closing the generator ends all work.

        Parameters
        ----------
        runs
            The runs to do.

        """


class LocalProcesses:
    """
    Engine that does runs in processes on this machine.

    The processes end with this one, even if it is killed.

    Parameters
    ----------
    work
        Does one run.
    workers
        Number of processes.

    """

    def __init__(self, work: Work, workers: int) -> None:
        self._work, self._workers = work, workers
        self._context = multiprocessing.get_context('spawn')

    def outcomes(self, runs: Sequence[Run]) -> Outcomes:
        """
        Do the runs, see `Engine.outcomes`.

        Parameters
        ----------
        runs
            The runs to do.

        """
        waiting = deque((run, 1) for run in runs)
        workers: dict[Connection, _Worker] = {}
        try:
            while waiting or workers:
                while waiting and len(workers) < self._workers:
                    worker = _Worker(self._context, self._work)
                    workers[worker.connection] = worker
                    worker.start(*waiting.popleft())
                for ready in wait([*workers]):
                    worker = workers[ready]  # type: ignore[index]
                    outcome = worker.outcome()
                    if isinstance(outcome, Crashed) and not outcome.is_final:
                        waiting.append((outcome.run, outcome.attempt + 1))
                    if worker.has_ended or not waiting:
                        del workers[worker.connection]
                        worker.end()
                    else:
                        worker.start(*waiting.popleft())
                    yield outcome
        finally:
            for worker in workers.values():
                worker.end()


class _Worker:
    """A process that does one run at a time, and the connection to it."""

    def __init__(self, context: SpawnContext, work: Work) -> None:
        self.connection, theirs = context.Pipe()
        self._process: BaseProcess = context.Process(
            target=_serve, args=(theirs, work), daemon=True
        )
        with _environment(), _uninterrupted():
            self._process.start()
        theirs.close()
        self.has_ended = False

    def start(self, run: Run, attempt: int) -> None:
        """Start a run; the process is idle."""
        self._run, self._attempt = run, attempt
        # If the process has ended, `outcome` says so.
        with contextlib.suppress(OSError):
            self.connection.send(run)

    def outcome(self) -> Done | Crashed:
        """Read what has become of the run, once the connection is ready."""
        try:
            answer = self.connection.recv()
        except (EOFError, OSError):
            self.has_ended = True
            self._process.join(_PATIENCE_S)
            answer = _ending(self._process.exitcode)
        if isinstance(answer, RunResult):
            return Done(self._run, answer)
        return Crashed(self._run, self._attempt, answer)

    def end(self) -> None:
        """End the process."""
        self.connection.close()
        self._process.terminate()
        self._process.join(_PATIENCE_S)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()


@contextlib.contextmanager
def _environment() -> Iterator[None]:
    """Set the environment variables of a process while it starts."""
    before = {name: os.environ.get(name) for name in ENVIRONMENT}
    os.environ.update(ENVIRONMENT)
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
    """Do runs until the connection is closed; the body of a worker process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all processes of a terminal
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDING)  # see _uninterrupted
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with contextlib.suppress(EOFError, OSError):
        while True:
            run = connection.recv()
            try:
                answer: RunResult | str = work(run)
            except Exception:
                answer = traceback.format_exc().strip()
            connection.send(answer)


def _end_with_parent() -> None:
    """End this process as soon as its parent has ended, however that was."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
