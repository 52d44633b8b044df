# SPDX-License-Identifier: Apache-2.0
"""Tests of the search for a policy that keeps the balance, and of what it writes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
import fcntl
from importlib import import_module
import os
from pathlib import Path
import resource
import signal
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

gymnasium = pytest.importorskip('gymnasium')

from humanoid_common.errors import UserError  # noqa: E402, I100
from humanoid_control.policy import Policy  # noqa: E402
from humanoid_control.policy.policy_file import read_policy_file  # noqa: E402
import humanoid_gym  # noqa: E402
from humanoid_gym import train_balance  # noqa: E402
from humanoid_gym.balance import (  # noqa: E402
    BalancePolicy,
    GAINS,
    initial_gains,
    JOINTS,
    weights_of,
    write_policy,
)
from humanoid_gym.episodes import EpisodeProcesses, TrainingError, Trial  # noqa: E402
from humanoid_gym.evolution import Search, SearchState  # noqa: E402
from humanoid_simulation.errors import SimulationError  # noqa: E402


def test_the_search_finds_the_best_of_a_valley() -> None:
    """Also where the parameters depend on each other, and count differently."""
    best = np.array([1.0, -2.0, 0.5, 3.0])
    valley = np.diag([1.0, 1.0, 10.0, 3.0])
    valley[0, 1], valley[1, 3] = 0.9, 0.5

    def value(parameters: np.ndarray) -> float:
        return -float(np.sum((valley @ (parameters - best)) ** 2))

    search = Search(SearchState.around(np.zeros(4), 0.5), seed=3, size=10)
    for _ in range(120):
        candidates = search.candidates()
        search.learn(candidates, np.array([value(each) for each in candidates]))
    assert search.state.mean == pytest.approx(best, abs=1e-3)


def test_a_search_goes_on_as_it_would_have(tmp_path: Path) -> None:
    """A checkpoint has all of it."""

    def go_on(search: Search, generations: int) -> None:
        for _ in range(generations):
            candidates = search.candidates()
            search.learn(candidates, -np.abs(candidates).sum(axis=1))

    whole = Search(SearchState.around(np.ones(3), 0.3), seed=1, size=6)
    go_on(whole, 6)
    half = Search(SearchState.around(np.ones(3), 0.3), seed=1, size=6)
    go_on(half, 3)
    half.state.save(tmp_path / 'checkpoint.npz')
    other = Search(SearchState.load(tmp_path / 'checkpoint.npz', 3), seed=1, size=6)
    go_on(other, 3)
    assert np.array_equal(other.state.mean, whole.state.mean)
    assert other.state.generation == 6


@pytest.mark.parametrize('content', [b'', b'PK', b'hello', b'\x93NUMPY'])
def test_a_file_that_is_no_checkpoint(tmp_path: Path, content: bytes) -> None:
    """It is refused with a sentence that says what to do."""
    path = tmp_path / 'checkpoint.npz'
    path.write_bytes(content)
    with pytest.raises(UserError, match=r'\.npz. is not a checkpoint of a search\. Move'):
        SearchState.load(path, 3)


@pytest.mark.parametrize(
    'changes',
    [
        {'mean': np.zeros(4)},
        {'covariance': np.eye(2)},
        {'sigma_path': np.full(3, np.nan)},
        {'sigma': np.array(0.0)},
        {'generation': np.array(-1)},
        {'mean': np.array(['a', 'b', 'c'])},
    ],
)
def test_a_checkpoint_of_another_search(tmp_path: Path, changes: dict[str, Any]) -> None:
    """With other sizes, or values that no search has, it is refused as well."""
    path = tmp_path / 'checkpoint.npz'
    replace(SearchState.around(np.zeros(3), 0.1), **changes).save(path)
    with pytest.raises(UserError, match='is not a checkpoint of a search'):
        SearchState.load(path, 3)


def test_a_full_disk_keeps_the_checkpoint_before(tmp_path: Path) -> None:
    """It is said in a sentence, and nothing unfinished stays."""
    path = tmp_path / 'checkpoint.npz'
    SearchState.around(np.zeros(3), 0.1).save(path)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
    try:
        with pytest.raises(SimulationError, match=r'checkpoint\.npz cannot be written: File too'):
            SearchState.around(np.ones(3), 0.1).save(path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert not SearchState.load(path, 3).mean.any()
    assert list(tmp_path.iterdir()) == [path]


def test_both_legs_do_the_same() -> None:
    """The first gains push the toes of both feet down when the robot leans forward."""
    weights = weights_of(initial_gains())
    gravity_x = 3
    for side in ('left', 'right'):
        assert weights[JOINTS.index(f'{side}_ankle_pitch'), gravity_x] > 0.0
    random = weights_of(np.random.default_rng(1).standard_normal(GAINS))
    assert random[:6] @ np.ones(30) == pytest.approx(random[6:] @ np.ones(30))
    assert np.count_nonzero(random[JOINTS.index('left_hip_yaw')]) == 0


def test_the_files_do_what_the_trained_policy_does(tmp_path: Path) -> None:
    """The controllers compute, from the sensors, the targets that the environment commands."""
    pytest.importorskip('onnxruntime')
    env: Any = gymnasium.make(humanoid_gym.STAND, noise=0.0).unwrapped
    observation, _ = env.reset(seed=1)
    joints = env.robot.backend.joints
    sensed = env.robot.backend.observe()['']
    gains = 0.3 * np.random.default_rng(2).standard_normal(GAINS)
    home_rad = dict(zip(joints, sensed.positions_rad.tolist(), strict=True))
    write_policy(tmp_path, gains, home_rad, 1.0 / env.stepped.step_s)
    trained = BalancePolicy(env.layout.slices, joints)
    trained.weights = weights_of(gains)
    written = Policy.load(tmp_path / 'stand.yaml', env.robot.walking.policy.robot)
    assert read_policy_file(tmp_path / 'stand.yaml').rate_hz == pytest.approx(50.0)
    env.robot.push(1.0 + 0.5j, 10.0)
    for _ in range(5):
        action = trained.action(observation)
        written.decide(env.robot.backend.observe()[''], np.zeros(3))
        observation, *_ = env.step(action)
        commanded = env.actions.targets(env.stepped.sensed).positions_rad[written.indices]
        sensed = env.robot.backend.observe()['']
        assert written.targets_rad(sensed) == pytest.approx(commanded, abs=1e-4)
    assert np.abs(action).max() > 0.01


SHORT = ('--candidates', '4', '--episodes', '1', '--steps', '5', '--processes', '1')
Train = Callable[..., int]


@pytest.fixture(name='train')
def _train(monkeypatch: pytest.MonkeyPatch) -> Train:
    """Return a function that runs the command with arguments, in this process."""

    def train(*arguments: str) -> int:
        monkeypatch.setattr(sys, 'argv', ['train_balance', *SHORT, *arguments])
        return train_balance.main()

    return train


def test_training_and_going_on(
    tmp_path: Path, train: Train, capsys: pytest.CaptureFixture[str]
) -> None:
    """A generation is a checkpoint; the next start goes on, and writes the policy."""
    for generations in ('1', '2'):
        assert train('--folder', str(tmp_path / 'a b'), '--generations', generations) == 0
    printed = capsys.readouterr().out
    assert printed.count('generation 0: ') == printed.count('generation 1: ') == 1
    assert 'after 2 generations' in printed
    assert read_policy_file(tmp_path / 'a b' / 'stand.yaml').joints == JOINTS


def test_two_trainings_in_a_folder(
    tmp_path: Path, train: Train, capsys: pytest.CaptureFixture[str]
) -> None:
    """The second one is told so, and changes nothing."""
    folder = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(folder, fcntl.LOCK_EX)
    try:
        assert train('--folder', str(tmp_path)) == 1
    finally:
        os.close(folder)
    assert f"Another training uses the folder '{tmp_path}'." in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_folders_that_cannot_be_used(
    tmp_path: Path, train: Train, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file, and a folder with something else in the place of the checkpoint."""
    (tmp_path / 'file').touch()
    (tmp_path / 'folder' / 'checkpoint.npz').mkdir(parents=True)
    assert train('--folder', str(tmp_path / 'file')) == 1
    assert "file' cannot be used: File exists. Give another --folder." in capsys.readouterr().err
    assert train('--folder', str(tmp_path / 'folder')) == 1
    assert "checkpoint.npz' cannot be read: Is a directory." in capsys.readouterr().err


def test_an_interruption_before_the_first_generation(
    tmp_path: Path, train: Train, monkeypatch: pytest.MonkeyPatch
) -> None:
    """There is no policy yet, and one that is there already stays; the signals work as before."""
    (tmp_path / 'stand.yaml').write_text('mine')

    def interrupt(*arguments: Any) -> None:
        signal.raise_signal(signal.SIGTERM)

    monkeypatch.setattr(train_balance, '_values', interrupt)
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    assert train('--folder', str(tmp_path)) == 0
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == before
    assert (tmp_path / 'stand.yaml').read_text() == 'mine'
    assert not (tmp_path / 'stand.onnx').exists()


def test_ctrl_c_while_modules_are_loaded(tmp_path: Path) -> None:
    """The program ends quietly, by the signal; nothing says that a library is missing."""
    text = "import os, signal\nos.kill(os.getpid(), signal.SIGINT)\nraise ImportError('half')\n"
    (tmp_path / 'gymnasium.py').write_text(text)
    program = Path(__file__).parents[1] / 'scripts' / 'train_balance'
    known = os.environ.get('PYTHONPATH', '')
    done = subprocess.run(
        [sys.executable, str(program), '--folder', str(tmp_path / 'balance')],
        env={**os.environ, 'PYTHONPATH': f'{tmp_path}{os.pathsep}{known}'},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, '', '')
    assert not (tmp_path / 'balance').exists()


EPISODES = """
import os
from pathlib import Path
import signal

MARK = Path(__file__).with_name('mark')

def dies_once(trial):
    if not MARK.exists():
        MARK.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return trial.seed

def dies(trial):
    os._exit(3)

def fails(trial):
    raise ValueError('no such thing')
"""


@pytest.fixture(name='episodes')
def _episodes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a module with episodes that other processes can import."""
    (tmp_path / 'fake_episodes.py').write_text(EPISODES)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, 'fake_episodes', raising=False)
    return import_module('fake_episodes')


def test_a_process_that_is_killed(episodes: Any) -> None:
    """Its episode runs again in another one."""
    trials = [Trial(np.zeros(1), seed) for seed in range(5)]
    with EpisodeProcesses(episodes.dies_once, 2) as processes:
        assert processes.earned(trials).tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]
        assert processes.earned(trials[3:]).tolist() == [3.0, 4.0]
    assert episodes.MARK.exists()


@pytest.mark.parametrize(
    ('name', 'reason'), [('dies', 'status 3'), ('fails', 'ValueError: no such thing')]
)
def test_episodes_that_cannot_be_run(episodes: Any, name: str, reason: str) -> None:
    """After a second attempt the training ends, and says why."""
    with EpisodeProcesses(getattr(episodes, name), 1) as processes:
        with pytest.raises(TrainingError, match=f'An episode cannot be run: .*{reason}'):
            processes.earned([Trial(np.zeros(1), 0)])


@pytest.mark.parametrize(
    ('arguments', 'sentence'),
    [
        (['--candidates', '3'], "'3' is not a whole number of at least 4."),
        (['--minutes', '0'], "'0' is not a number above zero"),
        (['--minutes', 'nan'], "'nan' is not a number above zero"),
        (['--steps', 'many'], "'many' is not a whole number of at least 1."),
        (['--folder', ''], 'an empty text names no folder.'),
        (['--seed', '-1'], "'-1' is not a whole number of at least 0."),
        (['--strongest-ns', '51'], 'The robot survives no push of more than 50 N s.'),
        (['--generations', '9' * 5000], 'is not a whole number of at least 1.'),
    ],
)
def test_mistakes_in_arguments(
    train: Train, capsys: pytest.CaptureFixture[str], arguments: list[str], sentence: str
) -> None:
    """Each is said, with status 2."""
    with pytest.raises(SystemExit) as caught:
        train(*arguments)
    assert caught.value.code == 2
    assert sentence in capsys.readouterr().err
