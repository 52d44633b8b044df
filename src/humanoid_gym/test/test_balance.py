# SPDX-License-Identifier: Apache-2.0
"""Tests of the search for a policy that keeps the balance, and of what it writes."""

from __future__ import annotations

from pathlib import Path
import signal
import sys
from typing import Any

import numpy as np
import pytest

gymnasium = pytest.importorskip('gymnasium')

from humanoid_control.policy import Policy  # noqa: E402, I100
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
from humanoid_gym.evolution import Search, SearchState  # noqa: E402


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
    other = Search(SearchState.load(tmp_path / 'checkpoint.npz'), seed=1, size=6)
    go_on(other, 3)
    assert np.array_equal(other.state.mean, whole.state.mean)
    assert other.state.generation == 6


@pytest.mark.parametrize('content', [b'', b'PK', b'hello', b'\x93NUMPY'])
def test_a_file_that_is_no_checkpoint(tmp_path: Path, content: bytes) -> None:
    """It is refused with a sentence that says what to do."""
    path = tmp_path / 'checkpoint.npz'
    path.write_bytes(content)
    with pytest.raises(ValueError, match=r'checkpoint\.npz. is no checkpoint of a search\. Move'):
        SearchState.load(path)


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


def test_training_and_going_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A generation is a checkpoint; the next start goes on, and writes the policy."""
    monkeypatch.setattr(signal, 'signal', lambda number, handler: None)
    for generations in ('1', '2'):
        monkeypatch.setattr(
            sys, 'argv',
            ['train_balance', '--folder', str(tmp_path), '--generations', generations,
             '--candidates', '4', '--episodes', '1', '--steps', '5', '--processes', '1'],
        )  # fmt: skip
        assert train_balance.main() == 0
    printed = capsys.readouterr().out
    assert printed.count('generation 0: ') == printed.count('generation 1: ') == 1
    assert 'after 2 generations' in printed
    assert read_policy_file(tmp_path / 'stand.yaml').joints == JOINTS


@pytest.mark.parametrize(
    ('arguments', 'sentence'),
    [
        (['--candidates', '3'], "'3' is no number of at least 4."),
        (['--minutes', '0'], "'0' is no number above zero."),
        (['--steps', 'many'], "'many' is no number of at least 1."),
    ],
)
def test_mistakes_in_arguments(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    sentence: str,
) -> None:
    """Each is said, with status 2."""
    monkeypatch.setattr(sys, 'argv', ['train_balance', *arguments])
    with pytest.raises(SystemExit) as caught:
        train_balance.main()
    assert caught.value.code == 2
    assert sentence in capsys.readouterr().err
