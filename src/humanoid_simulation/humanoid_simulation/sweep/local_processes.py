# SPDX-License-Identifier: Apache-2.0
"""Do runs on this machine's cores, each in one of several processes."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING

from humanoid_simulation.sweep import ENVIRONMENT
from humanoid_simulation.sweep.engine import Crashed, Done, Outcomes, Work
from humanoid_simulation.worker_process import Failure, WorkerProcess

if TYPE_CHECKING:  # processes of tests need not import the walk
    from humanoid_simulation.sweep.conditions import Run


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
