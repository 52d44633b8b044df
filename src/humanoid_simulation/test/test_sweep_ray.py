# SPDX-License-Identifier: Apache-2.0
"""Check what is given to a Ray cluster, and what becomes of runs there, with a fake cluster."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
import pickle
import socket
import sys
from types import ModuleType, SimpleNamespace
from typing import Any

from humanoid_simulation.errors import SimulationError
from humanoid_simulation.sweep import ray_cluster, ray_worker
from humanoid_simulation.sweep.conditions import Conditions, Run
from humanoid_simulation.sweep.engine import Crashed, Done, Notice
from humanoid_simulation.sweep.ray_cluster import RayCluster
from humanoid_simulation.sweep.results import RunResult
import pytest

CONDITIONS = [Conditions(seed=seed) for seed in range(40)]
RUNS = [Run(each, each.digest) for each in CONDITIONS]
STOOD = RunResult('stood', 20.0)
VERSION, RUN_S = 'v1', 2.5


class RayError(Exception):
    """As in Ray, the error of all that happens to tasks."""


class RayTaskError(RayError):
    """A task has raised something."""


class RuntimeEnvSetupError(RayError):
    """There cannot be a worker."""


class WorkerCrashedError(RayError):
    """The process of a task has ended."""


class NodeDiedError(RayError):
    """The machine of a task is lost."""


class FakeRay(ModuleType):
    """
    The part of the module `ray` that the engine uses.

    A task is done when it is asked for; `fate` may raise what happens to its runs instead.
    """

    def __init__(self) -> None:
        super().__init__('ray')
        self.exceptions = SimpleNamespace(
            RayError=RayError,
            RayTaskError=RayTaskError,
            RuntimeEnvSetupError=RuntimeEnvSetupError,
            WorkerCrashedError=WorkerCrashedError,
            NodeDiedError=NodeDiedError,
        )
        self.fate: Callable[[list[Run]], None] = lambda runs: None
        self.alive, self.cpus = 1, 3
        self.connected: dict[str, Any] = {}
        self.given: list[tuple[Callable[..., Any], tuple[Any, ...]]] = []
        self.sizes: list[int] = []
        self.most_at_once = 0
        self.cancelled: list[int] = []
        self.is_shut_down = False

    def init(self, **arguments: Any) -> None:
        self.connected = arguments

    def nodes(self) -> list[dict[str, bool]]:
        return [{'Alive': True}] * self.alive + [{'Alive': False}]

    def cluster_resources(self) -> dict[str, float]:
        return {'CPU': float(self.cpus)} if self.cpus else {}

    def remote(self, **options: Any) -> Callable[..., Any]:
        assert options == {'num_cpus': 1, 'max_retries': 0}

        def decorate(function: Callable[..., Any]) -> SimpleNamespace:
            def give(*arguments: Any) -> int:
                self.given.append((function, arguments))
                self.sizes.append(len(pickle.loads(arguments[1])[1]))
                return len(self.given) - 1

            return SimpleNamespace(remote=give)

        return decorate

    def wait(self, tasks: list[int], timeout: float) -> tuple[list[int], list[int]]:
        self.most_at_once = max(self.most_at_once, len(tasks))
        return tasks[:1], tasks[1:]

    def get(self, task: int) -> Any:
        function, arguments = self.given[task]
        self.fate(pickle.loads(arguments[1])[1])
        return function(*arguments)

    def cancel(self, task: int, *, force: bool) -> None:
        assert force
        self.cancelled.append(task)

    def shutdown(self) -> None:
        self.is_shut_down = True


@pytest.fixture
def ray(monkeypatch: pytest.MonkeyPatch) -> FakeRay:
    """Return a cluster of one machine, with a clock that only runs move."""
    fake = FakeRay()
    monkeypatch.setitem(sys.modules, 'ray', fake)
    monkeypatch.setattr(ray_worker, '_version', lambda: VERSION)
    monkeypatch.setattr(ray_worker, 'time', SimpleNamespace(monotonic=lambda: CLOCK[0]))
    return fake


CLOCK = [0.0]


def work(run: Run) -> RunResult:
    """Take a while, and stand; the run with seed 7 fails."""
    CLOCK[0] += RUN_S
    if run.conditions.seed == 7:
        raise ValueError('a bug')
    return STOOD


def cluster(workers: int | None = None) -> RayCluster:
    """Return the engine."""
    return RayCluster(work, 'auto', VERSION, workers)


def counted(outcomes: Sequence[Done | Crashed | Notice]) -> Counter[int]:
    """Count how often a run is done, by seed."""
    return Counter(each.run.conditions.seed for each in outcomes if isinstance(each, Done))


def without(*seeds: int) -> list[Run]:
    """Return the runs without some."""
    return [run for run in RUNS if run.conditions.seed not in seeds]


def test_each_run_is_done_once_in_tasks_of_ten_seconds(ray: FakeRay) -> None:
    """Until it is known how long a run takes, and at the end, tasks are small."""
    runs = without(7)
    outcomes = [*cluster().outcomes(runs)]
    assert counted(outcomes) == Counter(run.conditions.seed for run in runs)
    assert ray.sizes[:6] == [1] * 6 and max(ray.sizes) == 10.0 / RUN_S and ray.sizes[-1] == 1
    assert ray.most_at_once == 2 * 3
    assert outcomes[0] == Notice('The Ray cluster has 1 machine with 3 CPUs')
    assert ray.is_shut_down and not ray.cancelled


def test_the_workers_have_the_paths_and_threads_of_the_sweep(
    ray: FakeRay, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After their own paths; the address is that of the command."""
    monkeypatch.setenv('AMENT_PREFIX_PATH', '/here/install')
    [*cluster().outcomes(RUNS[:1])]
    variables = ray.connected['runtime_env']['env_vars']
    assert variables['AMENT_PREFIX_PATH'] == '${AMENT_PREFIX_PATH}:/here/install'
    assert variables['OMP_NUM_THREADS'] == '1' and ray.connected['address'] == 'auto'


def test_no_more_at_the_same_time_than_wanted(ray: FakeRay) -> None:
    """However many CPUs the cluster has."""
    assert len(counted([*cluster(workers=2).outcomes(without(7))])) == 39
    assert ray.most_at_once == 2


def test_nothing_to_do_needs_no_cluster(monkeypatch: pytest.MonkeyPatch) -> None:
    """As when everything is finished."""
    monkeypatch.setitem(sys.modules, 'ray', None)
    assert [*cluster().outcomes([])] == []


def test_a_run_that_ends_its_worker_is_found(ray: FakeRay) -> None:
    """The others of its task are done, once; it is tried twice by itself."""

    def fate(runs: list[Run]) -> None:
        if any(run.conditions.seed == 20 for run in runs):
            raise WorkerCrashedError

    ray.fate = fate
    outcomes = [*cluster().outcomes(without(7))]
    assert counted(outcomes) == Counter(run.conditions.seed for run in without(7, 20))
    crashes = [each for each in outcomes if isinstance(each, Crashed)]
    assert [(each.run, each.attempt) for each in crashes] == [(RUNS[20], 1), (RUNS[20], 2)]
    assert crashes[0].reason == 'its worker has ended (WorkerCrashedError)'
    notices = [each.sentence for each in outcomes if isinstance(each, Notice)]
    assert notices[1].endswith(
        'its worker has ended (WorkerCrashedError); 3 runs of it begin again'
    )


def test_an_exception_is_a_crash_of_its_run_only(ray: FakeRay) -> None:
    """It is tried twice; what else is in its task is done."""
    outcomes = [*cluster().outcomes(RUNS)]
    assert counted(outcomes) == Counter(run.conditions.seed for run in without(7))
    crashes = [each for each in outcomes if isinstance(each, Crashed)]
    assert [each.attempt for each in crashes] == [1, 2]
    assert 'ValueError: a bug' in crashes[1].reason


def test_a_lost_machine_is_no_attempt(ray: FakeRay) -> None:
    """All is done; the user hears of the loss, and how many machines are left."""
    ray.alive, ray.cpus = 2, 4
    lost: list[int] = []

    def fate(runs: list[Run]) -> None:
        if len(runs) == 3 and not lost:
            lost.append(runs[0].conditions.seed)
            ray.alive, ray.cpus = 1, 2
            raise NodeDiedError

    ray.fate = fate
    outcomes = [*cluster().outcomes(without(7))]
    assert counted(outcomes) == Counter(run.conditions.seed for run in without(7))
    assert not [each for each in outcomes if isinstance(each, Crashed)]
    assert [each.sentence for each in outcomes if isinstance(each, Notice)] == [
        'The Ray cluster has 2 machines with 4 CPUs',
        'A task of the Ray cluster failed: its machine was lost (NodeDiedError); 3 runs of it '
        'begin again',
        'The Ray cluster has 1 machine with 2 CPUs',
    ]


def test_a_run_that_takes_machines_with_it(ray: FakeRay) -> None:
    """It is given up at last."""
    tries: list[int] = []

    def fate(runs: list[Run]) -> None:
        if runs[0].conditions.seed == 3:
            tries.append(3)
            raise NodeDiedError

    ray.fate = fate
    outcomes = [*cluster().outcomes(RUNS[:5])]
    crashed = [each for each in outcomes if isinstance(each, Crashed)]
    assert len(tries) == ray_cluster.MACHINES and sorted(counted(outcomes)) == [0, 1, 2, 4]
    assert [each.is_final for each in crashed] == [True]
    assert crashed[0].reason == 'its machine was lost 4 times'


def test_a_cluster_without_cpus_is_told(ray: FakeRay) -> None:
    """Its runs wait for machines, such as those that an autoscaler adds."""
    ray.cpus = 0
    assert next(cluster().outcomes(RUNS[:1])) == Notice(
        'The Ray cluster has 1 machine with 0 CPUs; the runs wait for more'
    )


def test_another_version_is_refused(ray: FakeRay, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before its runs are even loaded; the sentence has both versions and the machine."""
    monkeypatch.setattr(ray_worker, '_version', lambda: 'v2')
    assert isinstance(ray_worker.do_runs(VERSION, b'what only v1 can load'), ray_worker.Refusal)
    with pytest.raises(SimulationError) as caught:
        [*cluster().outcomes(RUNS)]
    sentence = str(caught.value)
    assert ray_worker.socket.gethostname() in sentence
    assert 'another version of the code, v2; here it is v1' in sentence
    assert len(ray.cancelled) == 5 and ray.is_shut_down


@pytest.mark.parametrize(
    ('scene', 'sentence'),
    [('flat', 'has another scene flat'), ('/nowhere/hall.yaml', 'cannot read the scene /nowhere')],
)
def test_another_scene_is_refused(ray: FakeRay, scene: str, sentence: str) -> None:
    """The key of a run stands for what is in the file, which each machine reads for itself."""
    with pytest.raises(SimulationError, match=sentence):
        [*cluster().outcomes([Run(Conditions(scene=scene), 'the key of another file')])]


@pytest.mark.parametrize('error', [RayTaskError, RuntimeEnvSetupError])
def test_workers_that_cannot_do_runs(ray: FakeRay, error: type[RayError]) -> None:
    """As without this workspace: no other run would fare better."""

    def fate(runs: list[Run]) -> None:
        raise error('Traceback\nModuleNotFoundError: No module named humanoid_simulation')

    ray.fate = fate
    with pytest.raises(SimulationError, match='No module named humanoid_simulation. On each'):
        [*cluster().outcomes(RUNS)]
    assert ray.is_shut_down


def test_closing_cancels_what_has_begun(ray: FakeRay) -> None:
    """Also if the cluster does not answer any more."""
    outcomes = cluster().outcomes(RUNS)
    assert [isinstance(next(outcomes), kind) for kind in (Notice, Done)] == [True, True]
    outcomes.close()
    assert ray.cancelled == [1, 2, 3, 4, 5] and ray.is_shut_down


def test_ray_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is said in a sentence with two ways out."""
    monkeypatch.setitem(sys.modules, 'ray', None)
    with pytest.raises(SimulationError, match='needs the Python package ray .* leave --ray out'):
        [*cluster().outcomes(RUNS)]


def test_no_cluster(ray: FakeRay, monkeypatch: pytest.MonkeyPatch) -> None:
    """The sentence has the address, and what Ray says."""

    def refuse(**arguments: Any) -> None:
        raise ConnectionError('Could not find any running Ray instance.')

    monkeypatch.setattr(ray, 'init', refuse)
    with pytest.raises(SimulationError, match='at auto: Could not find any running Ray instance'):
        [*cluster().outcomes(RUNS)]


@pytest.mark.parametrize('address', ['127.0.0.1:{}', 'ray://127.0.0.1:{}', '[::1]:{}'])
def test_nothing_listens_at_an_address(ray: FakeRay, address: str) -> None:
    """It is said at once; Ray itself would try again for minutes."""
    with socket.socket() as reserved:  # bound, but nothing listens
        reserved.bind(('127.0.0.1', 0))
        address = address.format(reserved.getsockname()[1])
        with pytest.raises(SimulationError, match='Cannot connect to a Ray cluster at'):
            [*RayCluster(work, address, VERSION).outcomes(RUNS)]
    assert not ray.connected


def test_something_listens_at_an_address(ray: FakeRay) -> None:
    """Ray connects with it."""
    with socket.create_server(('127.0.0.1', 0)) as server:
        address = f'ray://127.0.0.1:{server.getsockname()[1]}'
        assert len([*RayCluster(work, address, VERSION).outcomes(RUNS[:1])]) == 2
    assert ray.connected['address'] == address
