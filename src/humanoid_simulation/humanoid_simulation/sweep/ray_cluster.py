# SPDX-License-Identifier: Apache-2.0
"""
Do runs on the machines of a Ray cluster.

A task of Ray is a batch of runs, of about ten seconds. A batch that is lost with its worker is
done again, each run by itself, so that one which ends its worker is found.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
import contextlib
from dataclasses import dataclass, replace
import os
import re
import socket
from typing import Any, TYPE_CHECKING

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.sweep import ENVIRONMENT
from humanoid_simulation.sweep.engine import ATTEMPTS, Crashed, Done, Notice, Outcomes, Work
from humanoid_simulation.sweep.ray_worker import do_runs, packed, Refusal
from humanoid_simulation.sweep.results import RunResult

if TYPE_CHECKING:  # processes of tests need not import the walk
    from humanoid_simulation.sweep.conditions import Run

TASK_S = 10.0
"""How long a task is to take: long against what Ray needs for it, short enough to be lost."""
MACHINES = 4
"""How many machines may be lost during a run, before it is thought to be the cause."""
_TASKS_EACH = 2
"""Tasks given to Ray for each CPU: one works, the other one waits for it."""
_LOOK_S = 1.0
"""How often to look for new machines."""
_REACH_S = 10.0
"""How long to wait for a connection with an address."""
_ADDRESS = re.compile(r'(?:ray://)?\[?(?P<host>[^/]+?)\]?:(?P<port>\d+)')
_PATHS = ('PYTHONPATH', 'AMENT_PREFIX_PATH')
"""Where Python and ROS find packages."""


@dataclass(frozen=True)
class _Attempt:
    """A run that is to be tried: which time, and how often it was lost with a machine."""

    run: Run
    number: int = 1
    losses: int = 0
    is_alone: bool = False
    """Whether it gets a task of its own, because its last worker has ended."""


_Batch = tuple[_Attempt, ...]


class RayCluster:
    """
    Engine that does runs on a Ray cluster.

    Parameters
    ----------
    work
        Does one run.
    address
        Address of the cluster, as `ray.init` knows it.
    version
        Version of the code, which the workers must have.
    workers
        How many tasks at the same time; None for as many as the cluster has CPUs.

    """

    def __init__(self, work: Work, address: str, version: str, workers: int | None = None) -> None:
        self._work, self._address, self._version = work, address, version
        self._workers = workers

    def outcomes(self, runs: Sequence[Run]) -> Outcomes:
        """
        Do the runs, see `Engine.outcomes`.

        Parameters
        ----------
        runs
            The runs to do.

        Raises
        ------
        SimulationError
            Ray is not installed, there is no cluster, or its workers cannot do these runs.

        """
        if not runs:
            return
        ray = _connect(self._address)
        tasks = _Tasks(ray, self._work, self._version, self._workers, runs)
        try:
            yield from tasks.outcomes()
        finally:
            tasks.cancel()
            ray.shutdown()


class _Tasks:
    """The runs that wait, and those that a connected cluster has been given."""

    def __init__(
        self, ray: Any, work: Work, version: str, workers: int | None, runs: Sequence[Run]
    ) -> None:
        self._ray, self._work, self._version, self._workers = ray, work, version, workers
        # This engine counts attempts itself: it alone knows which run was in them.
        self._task = ray.remote(num_cpus=1, max_retries=0)(do_runs)
        self._waiting = deque(map(_Attempt, runs))
        self._begun: dict[Any, _Batch] = {}
        self._size = (0, 0)
        self._duration_s, self._count = 0.0, 0

    def outcomes(self) -> Outcomes:
        """Do the runs."""
        while self._waiting or self._begun:
            yield from self._look()
            self._begin()
            ready, _ = self._ray.wait([*self._begun], timeout=_LOOK_S)
            for task in ready:
                yield from self._finish(task, self._begun.pop(task))

    def cancel(self) -> None:
        """End the tasks that have begun."""
        for task in self._begun:
            with contextlib.suppress(Exception):  # the cluster may be the reason for the end
                self._ray.cancel(task, force=True)

    def _look(self) -> Iterator[Notice]:
        """Count machines and CPUs, and tell when they have become more or fewer."""
        machines = sum(bool(node['Alive']) for node in self._ray.nodes())
        size = machines, int(self._ray.cluster_resources().get('CPU', 0))
        if size != self._size:
            self._size = size
            waits = '' if size[1] else '; the runs wait for more'
            yield Notice(
                f'The Ray cluster has {_counted(machines, "machine")} with '
                f'{_counted(size[1], "CPU")}{waits}'
            )

    def _begin(self) -> None:
        """Give the cluster as many tasks as it can do soon."""
        most = self._workers or _TASKS_EACH * max(self._size[1], 1)
        while self._waiting and len(self._begun) < most:
            batch = self._batch()
            package = packed(self._work, [attempt.run for attempt in batch])
            self._begun[self._task.remote(self._version, package)] = batch

    def _batch(self) -> _Batch:
        """Take runs for a task: few at first and at the end, so that no CPU waits for another."""
        if self._waiting[0].is_alone or not self._count:
            return (self._waiting.popleft(),)
        mean_s = max(self._duration_s / self._count, 1e-3)
        share = len(self._waiting) // (2 * (self._workers or max(self._size[1], 1)))
        most = max(1, min(round(TASK_S / mean_s), share))
        batch: list[_Attempt] = []
        while self._waiting and len(batch) < most and not self._waiting[0].is_alone:
            batch.append(self._waiting.popleft())
        return tuple(batch)

    def _finish(self, task: Any, batch: _Batch) -> Iterator[Done | Crashed | Notice]:
        """Tell what has become of a task that has ended."""
        errors = self._ray.exceptions
        try:
            answer = self._ray.get(task)
        except (errors.RayTaskError, errors.RuntimeEnvSetupError) as error:
            raise SimulationError(
                f'The workers of the Ray cluster cannot do runs: {_last_line(error)}. On each of '
                'its machines, build the same code and source it before Ray is started.'
            ) from error
        except errors.RayError as error:
            yield from self._lose(batch, error)
            return
        if isinstance(answer, Refusal):
            raise SimulationError(f'{answer.sentence} Finished runs are kept.')
        self._duration_s += answer.duration_s
        self._count += len(batch)
        for attempt, result in zip(batch, answer.results):
            if isinstance(result, RunResult):
                yield Done(attempt.run, result)
            else:
                yield self._crash(attempt, result)

    def _lose(self, batch: _Batch, error: Exception) -> Iterator[Crashed | Notice]:
        """Arrange for the runs of a task to be done again that has been lost."""
        is_of_machine = isinstance(error, self._ray.exceptions.NodeDiedError)
        reason = f'its {"machine was lost" if is_of_machine else "worker has ended"} '
        reason += f'({type(error).__name__})'
        if len(batch) == 1 and not is_of_machine:
            yield self._crash(batch[0], reason)
            return
        yield Notice(
            f'A task of the Ray cluster failed: {reason}; '
            f'{_counted(len(batch), "run")} of it begin again'
        )
        for attempt in batch:
            losses = attempt.losses + is_of_machine
            if losses < MACHINES:
                self._waiting.append(replace(attempt, losses=losses, is_alone=not is_of_machine))
            else:
                yield Crashed(attempt.run, ATTEMPTS, f'its machine was lost {losses} times')

    def _crash(self, attempt: _Attempt, reason: str) -> Crashed:
        """Tell that a run has crashed; it waits for another attempt if it has one left."""
        crashed = Crashed(attempt.run, attempt.number, reason)
        if not crashed.is_final:
            self._waiting.append(replace(attempt, number=attempt.number + 1, is_alone=True))
        return crashed


def _connect(address: str) -> Any:
    """Connect with a cluster, and return the module `ray`."""
    try:
        import ray
    except ImportError as error:
        raise SimulationError(
            f'--ray needs the Python package ray ({error}). Install it and give the same command '
            'again, or leave --ray out: the cores of this machine then do the runs.'
        ) from error
    _reach(address)
    # A path of the worker itself comes first.
    paths = {name: f'${{{name}}}:{os.environ.get(name, "")}' for name in _PATHS}
    try:
        ray.init(
            address=address,
            runtime_env={'env_vars': {**paths, **ENVIRONMENT}},
            logging_level='ERROR',
            log_to_driver=False,
        )
    except Exception as error:
        raise _no_connection(address, error) from error
    return ray


def _reach(address: str) -> None:
    """Check that something listens at an address with a port, where Ray would wait for minutes."""
    found = _ADDRESS.fullmatch(address)
    if found:
        try:
            socket.create_connection((found['host'], int(found['port'])), _REACH_S).close()
        except (OSError, OverflowError) as error:
            raise _no_connection(address, error) from error


def _no_connection(address: str, error: Exception) -> SimulationError:
    """Create the error for a cluster that cannot be reached."""
    return SimulationError(
        f'Cannot connect to a Ray cluster at {address}: {_last_line(error)}. Start one '
        'with `ray start --head`, or give the address that it has printed.'
    )


def _counted(number: int, noun: str) -> str:
    """Combine a number and a noun."""
    return f'{number} {noun}{"" if number == 1 else "s"}'


def _last_line(error: Exception) -> str:
    """Return the last line of an error that has a text, without its full stop."""
    lines = str(error).strip().splitlines() or [type(error).__name__]
    return lines[-1].strip().rstrip('.')
