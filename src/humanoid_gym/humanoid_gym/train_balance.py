# SPDX-License-Identifier: Apache-2.0
"""
Train a policy that keeps the balance under pushes, in `humanoid_gym/Stand-v0`.

It can be interrupted and started again: it goes on from its last generation. In the end it writes
the policy for the controllers of the robot, as stand.onnx and stand.yaml.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
import fcntl
import os
from pathlib import Path
import signal
import sys
import time
from typing import Any

import gymnasium
from humanoid_common.errors import UserError
from humanoid_common.naming import shortened
from humanoid_control.backends import Array
from humanoid_gym import STAND
from humanoid_gym.balance import initial_gains, write_policy
from humanoid_gym.episodes import EpisodeProcesses, Episodes, TrainingError, Trial
from humanoid_gym.evolution import Search, SearchState
from humanoid_simulation.files import folder_argument

SIGMA = 0.1
"""Standard deviation of the gains in the first generation."""
MOST_NS = 50.0
"""The strongest push to train with, in N s: even the robot's own walk survives no stronger one."""
_DIGITS = 16
"""Whole numbers have fewer digits than this."""
_ENDING = (signal.SIGINT, signal.SIGTERM)


def main() -> int:
    """
    Train from where the last training ended, and write the policy.

    Returns
    -------
    int
        Exit code: 0, also after Ctrl-C or SIGTERM; 1 if something is wrong.

    """
    arguments = _arguments()
    before = {number: signal.getsignal(number) for number in _ENDING}
    try:
        for number, handler in before.items():
            if handler is not signal.SIG_IGN:
                signal.signal(number, signal.default_int_handler)
        with _alone(arguments.folder):
            _go_on(arguments)
    except UserError as error:
        print(f'The training has stopped. {error}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print('Interrupted.')
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    return 0


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Make a folder, and keep other trainings out of it."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = os.open(folder, os.O_RDONLY)
    except OSError as error:
        raise TrainingError(
            f"The folder '{folder}' cannot be used: {error.strerror}. Give another --folder."
        ) from None
    try:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise TrainingError(
                f"Another training uses the folder '{folder}'. Wait for its end, or give another "
                '--folder.'
            ) from None
        yield
    finally:
        os.close(lock)


def _go_on(arguments: argparse.Namespace) -> None:
    """Train, and write the policy of the last generation that is finished."""
    checkpoint = arguments.folder / 'checkpoint.npz'
    state = SearchState.around(initial_gains(), SIGMA)
    if checkpoint.exists():
        state = _loaded(checkpoint, len(state.mean))
    state.save(checkpoint)  # a folder that cannot be written to is noticed before the work
    try:
        _train(arguments, Search(state, arguments.seed, arguments.candidates), checkpoint)
    except KeyboardInterrupt:
        for number in _ENDING:
            signal.signal(number, signal.SIG_IGN)  # it takes but a moment
        print('Interrupted. Start it again to go on.', flush=True)
        state = _loaded(checkpoint, len(state.mean))
    if not state.generation:
        print('No generation is finished, so there is no policy yet.')
        return
    env: Any = gymnasium.make(STAND).unwrapped
    env.reset(seed=0)
    positions_rad = env.robot.backend.observe()[''].positions_rad.tolist()
    home_rad = dict(zip(env.robot.backend.joints, positions_rad, strict=True))
    write_policy(arguments.folder, state.mean, home_rad, 1.0 / env.stepped.step_s)
    print(f'Wrote {arguments.folder / "stand.yaml"} after {int(state.generation)} generations.')


def _loaded(checkpoint: Path, size: int) -> SearchState:
    """Read a checkpoint of some number of parameters."""
    try:
        return SearchState.load(checkpoint, size)
    except OSError as error:
        raise TrainingError(f"'{checkpoint}' cannot be read: {error.strerror}.") from None


def _train(arguments: argparse.Namespace, search: Search, checkpoint: Path) -> None:
    """Go through generations until they, or the minutes, are over."""
    state, end_s = search.state, time.monotonic() + 60.0 * arguments.minutes
    episodes = Episodes(arguments.strongest_ns, arguments.steps)
    with EpisodeProcesses(episodes, arguments.processes) as processes:
        while state.generation < arguments.generations and time.monotonic() < end_s:
            number = int(state.generation)
            candidates = search.candidates()
            seeds = [number * arguments.episodes + each for each in range(arguments.episodes)]
            values = _values(processes, [*candidates, state.mean], seeds)
            print(
                f'generation {number}: their mean earns {values[-1]:.2f}, the best one '
                f'{values[:-1].max():.2f}; sigma is {float(state.sigma):.3f}',
                flush=True,
            )
            search.learn(candidates, values[:-1])
            state.save(checkpoint)


def _values(
    processes: EpisodeProcesses, all_gains: Sequence[Array], seeds: Sequence[int]
) -> Array:
    """Compute what each of some gains earns in an episode, on average over the seeds."""
    earned = processes.earned([Trial(gains, seed) for gains in all_gains for seed in seeds])
    values: Array = earned.reshape(len(all_gains), len(seeds)).mean(axis=1)
    return values


def _arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        prog='train_balance', description=(__doc__ or '').strip().split('\n')[0]
    )
    parser.add_argument(
        '--folder',
        type=folder_argument,
        default=Path('balance'),
        help='of the checkpoint and the policy',
    )
    parser.add_argument('--minutes', type=_above_zero(1e6), default=5.0, help='when to pause')
    parser.add_argument('--generations', type=_at_least(1), default=60)
    parser.add_argument('--candidates', type=_at_least(4), default=16)
    parser.add_argument('--episodes', type=_at_least(1), default=4, help='for each candidate')
    parser.add_argument('--steps', type=_at_least(1), default=300, help='of an episode')
    parser.add_argument(
        '--strongest-ns',
        type=_above_zero(MOST_NS, f'The robot survives no push of more than {MOST_NS:g} N s.'),
        default=20.0,
        help='push, in N s',
    )
    parser.add_argument('--processes', type=_at_least(1), default=2)
    parser.add_argument('--seed', type=_at_least(0), default=1, help='of the candidates')
    return parser.parse_args()


def _at_least(least: int) -> Callable[[str], int]:
    """Return what reads a whole number."""

    def read(text: str) -> int:
        if not (text.isascii() and text.isdigit() and len(text) < _DIGITS and int(text) >= least):
            raise argparse.ArgumentTypeError(
                f"'{shortened(text)}' is not a whole number of at least {least}."
            )
        return int(text)

    return read


def _above_zero(most: float, hint: str = '') -> Callable[[str], float]:
    """Return what reads a number above zero."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = 0.0
        if not 0.0 < value <= most:
            sentence = f"'{shortened(text)}' is not a number above zero, up to {most:g}. {hint}"
            raise argparse.ArgumentTypeError(sentence.strip())
        return value

    return read
