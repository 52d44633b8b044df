# SPDX-License-Identifier: Apache-2.0
"""Tests of what all environments promise to Gymnasium and to an agent."""

from __future__ import annotations

from collections.abc import Iterator
import subprocess
import sys
from typing import Any
import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip('gymnasium')

from gymnasium.utils.env_checker import check_env  # noqa: E402, I100
import humanoid_gym  # noqa: E402

IDS = (humanoid_gym.WALK, humanoid_gym.STAND, humanoid_gym.REACH)


@pytest.fixture(scope='module', params=IDS)
def env(request: pytest.FixtureRequest) -> Iterator[Any]:
    """Return each environment in turn."""
    made = gymnasium.make(request.param)
    yield made
    made.close()


def episode(env: Any, seed: int, steps: int = 30) -> list[np.ndarray]:
    """Return the observations of an episode with random actions."""
    observations = [env.reset(seed=seed)[0]]
    random = np.random.default_rng(7)
    for _ in range(steps):
        action = 0.2 * random.uniform(-1.0, 1.0, env.action_space.shape)
        observation, *_ = env.step(action.astype(np.float32))
        observations.append(observation)
    return observations


def test_gymnasium_finds_nothing_to_object_to(env: Any) -> None:
    """Its checker passes, without a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        check_env(env.unwrapped, skip_render_check=True)


def test_the_same_seed_is_the_same_episode(env: Any) -> None:
    """Bit for bit, whatever was before; another seed is another one."""
    first = episode(env, 3)
    other = episode(env, 4)
    again = episode(env, 3)
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_the_parts_of_the_observation(env: Any) -> None:
    """A robot that stands at rest measures gravity downwards, and its weight."""
    layout = env.unwrapped.layout
    observation, _ = env.reset(seed=1)
    for _ in range(50):
        observation, _, has_fallen, *_ = env.step(np.zeros(env.action_space.shape, np.float32))
    assert not has_fallen
    assert observation[layout.slices['gravity']] == pytest.approx([0.0, 0.0, -1.0], abs=0.1)
    mass_kg = float(env.unwrapped.robot.backend.model.body_mass.sum())
    weight_n = observation[layout.slices['foot_forces']].sum()
    assert weight_n == pytest.approx(9.81 * mass_kg, rel=0.2)


def test_the_reward_is_the_sum_of_its_terms(env: Any) -> None:
    """Each term is in the info; standing well is worth something."""
    env.reset(seed=1)
    _, reward, _, _, info = env.step(np.zeros(env.action_space.shape, np.float32))
    terms = [value for name, value in info.items() if name.startswith('reward_')]
    assert len(terms) > 4
    assert reward == pytest.approx(sum(terms))
    assert info['reward_alive'] > 0.0 and info['reward_torque'] < 0.0


@pytest.mark.parametrize('action', [np.zeros(2), np.full(23, np.nan)])
def test_an_action_that_is_none(action: np.ndarray) -> None:
    """Its mistake is said in a sentence, and no time passes."""
    env = gymnasium.make(humanoid_gym.STAND).unwrapped
    env.reset(seed=1)
    with pytest.raises(ValueError, match='Give 23 finite numbers from -1 to 1'):
        env.step(action)
    assert env.stepped.passed_s == 0.0


def test_mistakes_in_arguments() -> None:
    """What an environment cannot be is said in a sentence."""
    for arguments, sentence in (
        ({'render_mode': 'ansi'}, "There is no render mode 'ansi'"),
        ({'noise': -1.0}, 'The noise cannot be -1.0'),
        ({'actions': 'steps'}, "There are no actions 'steps'. Give joints or velocity."),
    ):
        with pytest.raises(ValueError, match=sentence), warnings.catch_warnings():
            warnings.simplefilter('ignore')  # gymnasium adds one of its own about a render mode
            gymnasium.make(humanoid_gym.WALK, **arguments)
    env = gymnasium.make(humanoid_gym.STAND)
    with pytest.raises(ValueError, match="no option 'velocity' for reset. It has none"):
        env.reset(options={'velocity': (0.1, 0.0, 0.0)})


def test_several_processes() -> None:
    """Each has a robot of its own, which starts from a seed of its own."""
    envs = gymnasium.make_vec(humanoid_gym.STAND, num_envs=2, vectorization_mode='async')
    try:
        first, _ = envs.reset(seed=5)
        observation, reward, terminated, truncated, _ = envs.step(np.zeros((2, 23), np.float32))
    finally:
        envs.close()
    assert observation.shape == first.shape == (2, envs.single_observation_space.shape[0])
    assert not np.array_equal(first[0], first[1])
    assert (reward > 0.0).all() and not terminated.any() and not truncated.any()


def test_pictures() -> None:
    """The camera sees the robot before the sky, and follows it."""
    env = gymnasium.make(humanoid_gym.STAND, render_mode='rgb_array', width=96, height=72)
    env.reset(seed=1)
    picture = env.render()
    env.close()
    assert picture.shape == (72, 96, 3) and picture.dtype == np.uint8
    corner, middle = picture[:8, :8].astype(float), picture[24:48, 36:60].astype(float)
    assert np.abs(middle - corner.mean(axis=(0, 1))).max() > 40.0
    assert middle.std() > corner.std()


def test_without_gymnasium() -> None:
    """Importing the package says what to install."""
    script = "import sys; sys.modules['gymnasium'] = None; import humanoid_gym"
    done = subprocess.run([sys.executable, '-c', script], capture_output=True, text=True)
    assert done.returncode == 1
    assert 'humanoid_gym needs the Python package gymnasium' in done.stderr
    assert 'install gymnasium, version 1 or later' in done.stderr
