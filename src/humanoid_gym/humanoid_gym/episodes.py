# SPDX-License-Identifier: Apache-2.0
"""Which episodes earn how much? They run in processes, one of which may crash."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from types import TracebackType
from typing import Any

import gymnasium
from humanoid_common.errors import UserError
from humanoid_control.backends import Array
from humanoid_gym import STAND
from humanoid_gym.balance import BalancePolicy, weights_of
from humanoid_simulation.sweep import ENVIRONMENT
from humanoid_simulation.worker_process import Failure, WorkerProcess
import numpy as np

ATTEMPTS = 2
"""How often an episode is tried whose process crashes."""


class TrainingError(UserError):
    """A training cannot begin or go on; the message says why."""


@dataclass(frozen=True)
class Trial:
    """An episode: the gains to try, and the seed of the pushes."""

    gains: Array
    seed: int


class Episodes:
    """
    Runs episodes, in an environment that is made for the first one.

    Parameters
    ----------
    strongest_ns
        The strongest push.
    steps
        Length of an episode, in steps.

    """

    def __init__(self, strongest_ns: float, steps: int) -> None:
        self._strongest_ns, self._steps = strongest_ns, steps
        self._env: Any = None

    def __call__(self, trial: Trial) -> float:
        """
        Run an episode, and return the sum of its rewards.

        Parameters
        ----------
        trial
            The gains and the seed.

        """
        if self._env is None:
            self._env = gymnasium.make(
                STAND, max_episode_steps=self._steps, strongest_ns=self._strongest_ns
            )
            robot = self._env.unwrapped
            self._policy = BalancePolicy(robot.layout.slices, robot.robot.backend.joints)
        self._policy.weights = weights_of(trial.gains)
        observation, _ = self._env.reset(seed=trial.seed)
        total, is_over = 0.0, False
        while not is_over:
            action = self._policy.action(observation)
            observation, reward, terminated, truncated, _ = self._env.step(action)
            total, is_over = total + float(reward), terminated or truncated
        return total


class EpisodeProcesses:
    """
    Processes that run episodes; they end with the block, or with this process if it is killed.

    Parameters
    ----------
    run
        Runs an episode, such as `Episodes`.
    processes
        How many episodes run at the same time.

    """

    def __init__(self, run: Callable[[Trial], float], processes: int) -> None:
        self._run, self._processes = run, processes
        self._workers: dict[Connection, WorkerProcess] = {}

    def __enter__(self) -> EpisodeProcesses:
        """Return itself; the processes start when there are episodes."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """End the processes, whatever they do."""
        for worker in self._workers.values():
            worker.end()

    def earned(self, trials: Sequence[Trial]) -> Array:
        """
        Run episodes.

        Parameters
        ----------
        trials
            The n episodes.

        Returns
        -------
        Array
            What each of them has earned (n,).

        Raises
        ------
        TrainingError
            The process of an episode has crashed, and once more when it was tried again.

        """
        earned, crashes = np.zeros(len(trials)), Counter[int]()
        waiting, busy = deque(range(len(trials))), dict[Connection, int]()
        while waiting or busy:
            while waiting and len(busy) < self._processes:
                worker = self._idle(busy)
                busy[worker.connection] = waiting.popleft()
                worker.start(trials[busy[worker.connection]])
            for ready in wait([*busy]):
                worker = self._workers[ready]  # type: ignore[index]
                number, outcome = busy.pop(worker.connection), worker.outcome()
                if worker.has_ended:
                    del self._workers[worker.connection]
                    worker.end()
                if not isinstance(outcome, Failure):
                    earned[number] = outcome
                    continue
                crashes[number] += 1
                if crashes[number] == ATTEMPTS:
                    why = outcome.reason.splitlines()[-1]
                    raise TrainingError(f'An episode cannot be run: {why}.')
                waiting.append(number)
        return earned

    def _idle(self, busy: dict[Connection, int]) -> WorkerProcess:
        """Return a process without an episode; start one if there is none."""
        for connection, worker in self._workers.items():
            if connection not in busy:
                return worker
        worker = WorkerProcess(self._run, ENVIRONMENT)
        self._workers[worker.connection] = worker
        return worker
