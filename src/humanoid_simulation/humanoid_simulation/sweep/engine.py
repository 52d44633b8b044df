# SPDX-License-Identifier: Apache-2.0
"""Do many runs in parallel: the interface of engines, and the one on this machine's cores."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Protocol, TYPE_CHECKING

from humanoid_simulation.sweep import ENVIRONMENT
from humanoid_simulation.sweep.results import RunResult
from humanoid_simulation.worker_process import Failure, WorkerProcess

if TYPE_CHECKING:  # processes of tests need not import the walk
    from humanoid_simulation.sweep.conditions import Run

Work = Callable[['Run'], RunResult]
"""Does one run; other processes import it by its module and name."""
ATTEMPTS = 2
"""How often a run is tried whose process crashes."""


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
                    worker = _Worker(self._work)
                    workers[worker.connection] = worker
                    worker.attempt(*waiting.popleft())
                for ready in wait([*workers]):
                    worker = workers[ready]  # type: ignore[index]
                    outcome = worker.ended_run()
                    if isinstance(outcome, Crashed) and not outcome.is_final:
                        waiting.append((outcome.run, outcome.attempt + 1))
                    if worker.has_ended or not waiting:
                        del workers[worker.connection]
                        worker.end()
                    else:
                        worker.attempt(*waiting.popleft())
                    yield outcome
        finally:
            for worker in workers.values():
                worker.end()


class _Worker(WorkerProcess):
    """A process that does runs."""

    def __init__(self, work: Work) -> None:
        super().__init__(work, ENVIRONMENT)

    def attempt(self, run: Run, attempt: int) -> None:
        """Start a run; the process is idle."""
        self._run, self._attempt = run, attempt
        self.start(run)

    def ended_run(self) -> Done | Crashed:
        """Read what has become of the run, once the connection is ready."""
        outcome = self.outcome()
        if isinstance(outcome, Failure):
            return Crashed(self._run, self._attempt, outcome.reason)
        return Done(self._run, outcome)
