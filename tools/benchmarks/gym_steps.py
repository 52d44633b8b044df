# SPDX-License-Identifier: Apache-2.0
"""
Measure how many steps a second the Gymnasium environments do.

`make bench ARGS='--runs 5'`. Actions are random and small; an episode that ends is followed by
another one. The first table is of one process, in CPU time; the second one of as many processes as
there are cores, in real time.
"""

from __future__ import annotations

import argparse
import os
from statistics import median
import time
from typing import Any

from arguments import in_range
import gymnasium
import humanoid_gym
import numpy as np

ROWS: tuple[tuple[str, dict[str, str]], ...] = (
    (humanoid_gym.WALK, {}),
    (humanoid_gym.WALK, {'actions': 'velocity'}),
    (humanoid_gym.STAND, {}),
    (humanoid_gym.REACH, {}),
)
STEPS = 1000
SHARE = 0.1
"""Of the range of the actions."""


def main() -> None:
    """Measure and print both tables."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument('--runs', type=in_range(int, 1), default=3, help='runs of each row')
    runs = parser.parse_args().runs
    print(f'{"steps/s":>8} {"reset ms":>9}  one process, CPU time, median of {runs} runs')
    for name, arguments in ROWS:
        measured = [one_process(name, arguments) for _ in range(runs)]
        rate, reset_ms = (median(values) for values in zip(*measured))
        print(f'{rate:8.0f} {reset_ms:9.1f}  {title(name, arguments)}', flush=True)
    processes = os.cpu_count() or 1
    print(f'\n{"steps/s":>8}  {processes} processes together, real time, median of {runs} runs')
    for name, arguments in ROWS:
        rate = median(several_processes(name, arguments, processes) for _ in range(runs))
        print(f'{rate:8.0f}  {title(name, arguments)}', flush=True)


def title(name: str, arguments: dict[str, str]) -> str:
    """
    Return the name of a row.

    Parameters
    ----------
    name, arguments
        The environment, and its arguments.

    """
    return ' '.join([name, *(f'{key}={value}' for key, value in arguments.items())])


def one_process(name: str, arguments: dict[str, str]) -> tuple[float, float]:
    """
    Measure an environment in this process.

    Parameters
    ----------
    name, arguments
        The environment, and its arguments.

    Returns
    -------
    float, float
        Steps per second of CPU time, without resets, and the CPU time of a reset in ms.

    """
    env: Any = gymnasium.make(name, **arguments)
    random = np.random.default_rng(0)
    env.reset(seed=0)
    spent_s, resets_s = 0.0, []
    for _ in range(STEPS):
        action = SHARE * random.uniform(-1.0, 1.0, env.action_space.shape).astype(np.float32)
        begin_s = time.process_time()
        _, _, terminated, truncated, _ = env.step(action)
        spent_s += time.process_time() - begin_s
        if terminated or truncated or not resets_s:
            begin_s = time.process_time()
            env.reset()
            resets_s.append(time.process_time() - begin_s)
    env.close()
    return STEPS / spent_s, 1e3 * sum(resets_s) / len(resets_s)


def several_processes(name: str, arguments: dict[str, str], processes: int) -> float:
    """
    Measure environments in processes of their own, with resets.

    Parameters
    ----------
    name, arguments
        The environment, and its arguments.
    processes
        How many there are.

    Returns
    -------
    float
        Steps of all processes together per second of real time.

    """
    envs: Any = gymnasium.make_vec(
        name, num_envs=processes, vectorization_mode='async', **arguments
    )
    random = np.random.default_rng(0)
    envs.reset(seed=0)
    begin_s = time.monotonic()
    for _ in range(STEPS):
        envs.step(SHARE * random.uniform(-1.0, 1.0, envs.action_space.shape).astype(np.float32))
    rate = STEPS * processes / (time.monotonic() - begin_s)
    envs.close()
    return rate


if __name__ == '__main__':
    main()
