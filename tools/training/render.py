#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Render the pictures that the detector is trained and evaluated on.

It can be interrupted and started again: it goes on with the shard that it was at. Pictures depend
on the seed and the number of their shard alone.
"""

from __future__ import annotations

import argparse
from pathlib import Path
import time

from home_colours import HELD_OUT, SPLITS, TRAINING
from homes import home_of, random_home
from humanoid_simulation.model import humanoid, RobotDescription
from humanoid_simulation.scene import load_scene
import numpy as np
from photographs import Photograph, Photographer
import pictures
from pictures import GL, RAYS

DATA = Path('~/.cache/humanoid_training').expanduser()
PER_SHARD, PER_HOME = 240, 12
PARTS = {
    'validation': (0, HELD_OUT, 480),
    'training': (2, TRAINING, 7200),
    'test': (1, HELD_OUT, 1440),
    'apartment': (3, 'apartment', 480),
}
"""For each folder the number that its seed begins with, the split its homes are from, or the scene
that it shows as it is, and how many pictures it has."""
RAYS_SHARE = 0.22


def main() -> None:
    """Render all that is missing."""
    arguments = _arguments()
    description = humanoid()
    for name, (first, split, usual) in PARTS.items():
        if arguments.only not in (None, name):
            continue
        count = arguments.pictures if name == 'training' else usual
        for number in range(-(-count // PER_SHARD)):
            if pictures.is_there(arguments.data / name, number):
                continue
            generator = np.random.default_rng([arguments.seed, first, number])
            started_s = time.perf_counter()
            shard = _shard(description, split, generator, arguments.method)
            pictures.write(arguments.data / name, number, shard)
            each_ms = 1e3 * (time.perf_counter() - started_s) / PER_SHARD
            print(f'{name} {number}: {each_ms:.0f} ms a picture', flush=True)


def _arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--data', type=Path, default=DATA, help='the folder of the pictures')
    parser.add_argument('--only', choices=tuple(PARTS), help='one of the parts')
    parser.add_argument('--pictures', type=int, default=PARTS['training'][2],
                        help='how many pictures to train on')  # fmt: skip
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--method', choices=('egl', 'osmesa'), default='egl')
    return parser.parse_args()


def _shard(
    description: RobotDescription, split: str, generator: np.random.Generator, method: str
) -> pictures.Shard:
    """Photograph some homes."""
    taken: list[Photograph] = []
    while len(taken) < PER_SHARD:
        is_random = split in SPLITS
        home = random_home(generator, split) if is_random else home_of(load_scene(split))
        photographer = Photographer(description, home, split, generator, method, is_random)
        for _ in range(PER_HOME if is_random else PER_SHARD):
            taken.append(photographer.take(RAYS if generator.random() < RAYS_SHARE else GL))
        photographer.close()
    return pictures.Shard(
        np.stack([each.color for each in taken]),
        tuple(each.labels for each in taken),
        np.array([each.renderer for each in taken]),
    )


if __name__ == '__main__':
    main()
