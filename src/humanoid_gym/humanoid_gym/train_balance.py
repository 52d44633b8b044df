# SPDX-License-Identifier: Apache-2.0
"""
Train a policy that keeps the balance under pushes, in `humanoid_gym/Stand-v0`.

It can be interrupted and started again: it goes on from its last generation. In the end it writes
the policy for the controllers of the robot, as stand.onnx and stand.yaml.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass
import multiprocessing
from multiprocessing.pool import Pool
from pathlib import Path
import signal
import sys
import time
from typing import Any, TypeVar

import gymnasium
from humanoid_control.backends import Array
from humanoid_gym import STAND
from humanoid_gym.balance import BalancePolicy, initial_gains, weights_of, write_policy
from humanoid_gym.evolution import Search, SearchState
import numpy as np

Number = TypeVar('Number', int, float)
SIGMA = 0.1
"""Standard deviation of the gains in the first generation."""


@dataclass(frozen=True)
class Trial:
    """An episode: the gains to try, and the seed of the pushes."""

    gains: Array
    seed: int


class Worker:
    """
    A process with an environment of its own.

    Parameters
    ----------
    strongest_ns
        The strongest push.
    steps
        Length of an episode, in steps.

    """

    current: Worker

    def __init__(self, strongest_ns: float, steps: int) -> None:
        self._env: Any = gymnasium.make(STAND, max_episode_steps=steps, strongest_ns=strongest_ns)
        robot = self._env.unwrapped
        self._policy = BalancePolicy(robot.layout.slices, robot.robot.backend.joints)

    def earned(self, trial: Trial) -> float:
        """
        Run an episode, and return the sum of its rewards.

        Parameters
        ----------
        trial
            The gains and the seed.

        """
        self._policy.weights = weights_of(trial.gains)
        observation, _ = self._env.reset(seed=trial.seed)
        total, is_over = 0.0, False
        while not is_over:
            action = self._policy.action(observation)
            observation, reward, terminated, truncated, _ = self._env.step(action)
            total, is_over = total + float(reward), terminated or truncated
        return total


def _start_worker(strongest_ns: float, steps: int) -> None:
    """Make the environment of a process; only the main one obeys Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    Worker.current = Worker(strongest_ns, steps)


def _earned(trial: Trial) -> float:
    """Run an episode in the environment of this process."""
    return Worker.current.earned(trial)


def main() -> int:
    """Train from where the last training ended, and write the policy."""
    arguments = _arguments()
    checkpoint = arguments.folder / 'checkpoint.npz'
    try:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        if checkpoint.exists():
            state = SearchState.load(checkpoint)
        else:
            state = SearchState.around(initial_gains(), SIGMA)
    except (OSError, ValueError) as error:
        print(f'The training cannot begin: {error}', file=sys.stderr)
        return 1
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        _train(arguments, Search(state, arguments.seed, arguments.candidates), checkpoint)
    except KeyboardInterrupt:
        print('Interrupted. Start it again to go on.')
    env: Any = gymnasium.make(STAND).unwrapped
    env.reset(seed=0)
    positions_rad = env.robot.backend.observe()[''].positions_rad.tolist()
    home_rad = dict(zip(env.robot.backend.joints, positions_rad, strict=True))
    write_policy(arguments.folder, state.mean, home_rad, 1.0 / env.stepped.step_s)
    print(f'Wrote {arguments.folder / "stand.yaml"} after {int(state.generation)} generations.')
    return 0


def _train(arguments: argparse.Namespace, search: Search, checkpoint: Path) -> None:
    """Go through generations until they, or the minutes, are over."""
    state, end_s = search.state, time.monotonic() + 60.0 * arguments.minutes
    options = arguments.strongest_ns, arguments.steps
    with multiprocessing.Pool(arguments.processes, _start_worker, options) as pool:
        while state.generation < arguments.generations and time.monotonic() < end_s:
            number = int(state.generation)
            candidates = search.candidates()
            seeds = [number * arguments.episodes + each for each in range(arguments.episodes)]
            values = _values(pool, [*candidates, state.mean], seeds)
            print(
                f'generation {number}: their mean earns {values[-1]:.2f}, the best one '
                f'{values[:-1].max():.2f}; sigma is {float(state.sigma):.3f}',
                flush=True,
            )
            search.learn(candidates, values[:-1])
            state.save(checkpoint)


def _values(pool: Pool, all_gains: Sequence[Array], seeds: Sequence[int]) -> Array:
    """Compute what each of some gains earns in an episode, on average over the seeds."""
    trials = [Trial(gains, seed) for gains in all_gains for seed in seeds]
    earned = np.array(pool.map(_earned, trials, chunksize=1))
    values: Array = earned.reshape(len(all_gains), len(seeds)).mean(axis=1)
    return values


def _arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').strip().split('\n')[0])
    parser.add_argument(
        '--folder', type=Path, default=Path('balance'), help='of the checkpoint and the policy'
    )
    parser.add_argument('--minutes', type=_positive(float), default=5.0, help='when to pause')
    parser.add_argument('--generations', type=_positive(int), default=60)
    parser.add_argument('--candidates', type=_positive(int, 4), default=16)
    parser.add_argument('--episodes', type=_positive(int), default=4, help='for each candidate')
    parser.add_argument('--steps', type=_positive(int), default=300, help='of an episode')
    parser.add_argument('--strongest-ns', type=_positive(float), default=20.0, help='push, in N s')
    parser.add_argument('--processes', type=_positive(int), default=2)
    parser.add_argument('--seed', type=int, default=1)
    return parser.parse_args()


def _positive(kind: type[Number], least: int = 1) -> Callable[[str], Number]:
    """Return what reads an argument of at least a value; of a float, any above zero."""

    def read(text: str) -> Number:
        try:
            value = kind(text)
        except ValueError:
            value = kind(0)
        if not (value >= least if kind is int else 0.0 < value < 1e6):
            low = f'of at least {least}' if kind is int else 'above zero'
            raise argparse.ArgumentTypeError(f"'{text}' is no number {low}.")
        return value

    return read


if __name__ == '__main__':
    sys.exit(main())
