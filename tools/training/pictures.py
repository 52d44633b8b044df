# SPDX-License-Identifier: Apache-2.0
"""Labelled pictures, and their files: a folder for each part, in shards of a few hundred."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

CLASSES = (
    'mug', 'bottle', 'can', 'bowl', 'ball', 'apple', 'orange', 'box', 'cube', 'book', 'person',
)  # fmt: skip
"""The classes of the detector, in the order of its outputs."""
GL, RAYS = 0, 1
"""What drew a picture."""
Labels = NDArray[np.float32]
"""
(n, 8), a row for each visible thing: class; x1, y1, x2, y2 in pixels, of the edges of the visible
part; visible part of its outline, 0 to 1; number of visible pixels; distance from the camera in m.
"""
COLUMNS = 8
CLASS, BOX, VISIBLE, PIXELS, DISTANCE = 0, slice(1, 5), 5, 6, 7

_PICTURES, _LABELS = 'pictures_{:03d}.npy', 'labels_{:03d}.npz'


@dataclass(frozen=True, eq=False)
class Shard:
    """Pictures and what they show."""

    colors: NDArray[np.uint8]
    """(n, height, width, 3)"""
    labels: tuple[Labels, ...]
    renderers: NDArray[np.int64]
    """(n,) `GL` or `RAYS`"""


def is_there(folder: Path, number: int) -> bool:
    """
    Whether a shard was written to its end.

    Parameters
    ----------
    folder, number
        The folder of the part, and the number of the shard.

    """
    return (folder / _LABELS.format(number)).exists()


def write(folder: Path, number: int, shard: Shard) -> None:
    """
    Write a shard; one that was begun and not ended does not count.

    Parameters
    ----------
    folder, number
        The folder of the part, which is made if it is missing, and the number of the shard.
    shard
        The pictures and what they show.

    """
    folder.mkdir(parents=True, exist_ok=True)
    np.save(folder / _PICTURES.format(number), shard.colors)
    rows = [np.empty((0, COLUMNS), np.float32), *shard.labels]
    unfinished = folder / f'unfinished_{number:03d}.npz'
    np.savez(
        unfinished,
        rows=np.concatenate(rows),
        counts=np.array([len(each) for each in shard.labels], dtype=np.int64),
        renderers=shard.renderers,
    )
    unfinished.rename(folder / _LABELS.format(number))


def read(folder: Path, number: int) -> Shard:
    """
    Read a shard; its pictures stay in the file until they are used.

    Parameters
    ----------
    folder, number
        The folder of the part, and the number of the shard.

    """
    colors = np.load(folder / _PICTURES.format(number), mmap_mode='r')
    with np.load(folder / _LABELS.format(number)) as stored:
        ends = np.cumsum(stored['counts'])
        labels = tuple(np.split(stored['rows'], ends[:-1]))
        return Shard(colors, labels, stored['renderers'])


def shards(folder: Path) -> Iterator[Shard]:
    """
    Yield all shards of a folder that are complete, in order.

    Parameters
    ----------
    folder
        The folder of the part.

    Yields
    ------
    Shard
        Its pictures stay in the file until they are used.

    """
    pattern = _LABELS.format(0).replace('000', '*')
    for path in sorted(folder.glob(pattern)):
        yield read(folder, int(path.stem.split('_')[1]))


def numbers(folder: Path) -> Sequence[int]:
    """
    Return the numbers of the shards of a folder that are complete, in order.

    Parameters
    ----------
    folder
        The folder of the part.

    """
    pattern = _LABELS.format(0).replace('000', '*')
    return sorted(int(path.stem.split('_')[1]) for path in folder.glob(pattern))
