#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""
Train the detector on rendered pictures.

It can be interrupted and started again: it goes on from the last checkpoint, with the batches that
it would have had. The weights that are kept are those of a moving average that was best on the
pictures for validation. The rate of learning falls in the last quarter of all steps.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
import signal
import time
from typing import Any

from batches import Album, Batch, letterboxed, stacked
from boxes import Cells, corners, decoded, suppressed
from checkpoints import load, save, State
import jax
import jax.numpy as jnp
from jax_operations import outputs, Statistics, Weights
from losses import flat, loss
from metrics import Counted, Detections, mean_average_precision, quality
from network import HEIGHT_PX, WIDTH_PX
import numpy as np
import optax
import pictures
from pictures import CLASSES

DATA = Path('~/.cache/humanoid_training').expanduser()
STEPS = 32000
RATE, WARM_UP_STEPS, DECAY_SHARE, LAST_RATE = 2e-3, 200, 0.25, 0.02
WEIGHT_DECAY = 0.02
AVERAGE = 0.998
"""Of the moving average of weights: how much of it stays at each step."""
STATISTICS_AVERAGE = 0.97
SAVE_EVERY_S = 120.0
EVALUATE_EVERY = 1000
_AT_ONCE = 8


def main() -> None:
    """Train from where the last training ended."""
    arguments = _arguments()
    folder = arguments.data / 'run'
    folder.mkdir(parents=True, exist_ok=True)
    jax.config.update('jax_compilation_cache_dir', str(arguments.data / 'compiled'))
    optimizer = make_optimizer(arguments.steps)
    state = load(folder / 'checkpoint.npz', optimizer, arguments.seed)
    training = Training(arguments.data, folder, state, optimizer, arguments.seed)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        training.run(arguments.steps)
    except KeyboardInterrupt:
        save(folder / 'checkpoint.npz', training.state)
        print(f'Interrupted at step {training.state["step"]}. Start it again to go on.')


def _arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--data', type=Path, default=DATA, help='the folder of the pictures')
    parser.add_argument('--steps', type=int, default=STEPS)
    parser.add_argument('--seed', type=int, default=1)
    return parser.parse_args()


def make_optimizer(steps: int) -> optax.GradientTransformation:
    """
    Make AdamW (Loshchilov and Hutter, 2019), whose learning rate falls in the last steps.

    Parameters
    ----------
    steps
        How many steps the whole training has.

    """
    decay = max(1, int(DECAY_SHARE * steps))
    rate = optax.join_schedules(
        [
            optax.linear_schedule(0.0, RATE, WARM_UP_STEPS),
            optax.constant_schedule(RATE),
            optax.cosine_decay_schedule(RATE, decay, LAST_RATE),
        ],
        [WARM_UP_STEPS, max(WARM_UP_STEPS + 1, steps - decay)],
    )
    return optax.chain(
        optax.clip_by_global_norm(10.0),
        optax.adamw(rate, b2=0.99, weight_decay=WEIGHT_DECAY, mask=_is_weight),
    )


def _is_weight(weights: Weights) -> dict[str, bool]:
    """Which numbers are to stay small."""
    return {name: name.endswith('/weight') for name in weights}


class Training:
    """
    A training, its pictures and its files.

    Parameters
    ----------
    data
        The folder with the parts `training` and `validation` of the pictures.
    folder
        Where checkpoints, the best weights and the progress are written.
    state
        Where to go on, as from `checkpoints.load`.
    optimizer
        The optimizer.
    seed
        Of the batches.

    """

    def __init__(
        self,
        data: Path,
        folder: Path,
        state: State,
        optimizer: optax.GradientTransformation,
        seed: int,
    ) -> None:
        self.state = state
        self._album = Album(data / 'training')
        self._validation = list(pictures.shards(data / 'validation'))
        self._folder, self._seed = folder, seed
        self._step = make_step(optimizer)
        self._best = _best_of(folder / 'progress.csv')

    def run(self, steps: int) -> None:
        """
        Train until so many steps are done in all, with checkpoints and evaluations meanwhile.

        Parameters
        ----------
        steps
            The number of steps, those of earlier runs included.

        """
        saved_s = time.monotonic()
        with ThreadPoolExecutor(1) as loader:
            following = loader.submit(self._batch, self.state['step'])
            while self.state['step'] < steps:
                batch = following.result()
                following = loader.submit(self._batch, self.state['step'] + 1)
                value = self.advance(batch)
                done = self.state['step']
                if done % 20 == 0:
                    print(f'step {done}: loss {float(value):.3f}', flush=True)
                if done % EVALUATE_EVERY == 0 or done == steps:
                    self._evaluate(float(value))
                if time.monotonic() > saved_s + SAVE_EVERY_S or done == steps:
                    save(self._folder / 'checkpoint.npz', self.state)
                    saved_s = time.monotonic()

    def advance(self, batch: Batch) -> Any:
        """
        Do one step of training; return its loss.

        Parameters
        ----------
        batch
            The pictures and targets of the step.

        """
        parts = {name: value for name, value in self.state.items() if name != 'step'}
        done = self.state['step'] + 1
        average = min(AVERAGE, done / (done + 10.0))
        changed, value = self._step(
            parts, batch.pictures, batch.boxes, batch.classes, batch.weights, average
        )
        self.state = {**changed, 'step': done}
        return value

    def _batch(self, step: int) -> Batch:
        """Return the batch of a step, with new pictures if there are some."""
        if step % 200 == 0:
            self._album.refresh()
        return self._album.batch(self._seed, step)

    def _evaluate(self, value: float) -> None:
        """Note how good the averaged weights are; keep them if they are the best so far."""
        weights, statistics = self.state['averaged'], self.state['averaged_statistics']
        found = mean_precision(weights, statistics, self._validation)
        line = f'{self.state["step"]},{value:.4f},{found:.4f},{self._album.refresh()}'
        print(f'step, loss, mAP50, pictures: {line}', flush=True)
        with (self._folder / 'progress.csv').open('a', encoding='utf-8') as file:
            file.write(line + '\n')
        if found >= self._best:
            self._best = found
            save(self._folder / 'best.npz', self.state)


def _best_of(path: Path) -> float:
    """Return the best average precision that a file of progress tells of."""
    if not path.exists():
        return 0.0
    lines = path.read_text(encoding='utf-8').splitlines()
    return max((float(line.split(',')[2]) for line in lines), default=0.0)


def make_step(optimizer: optax.GradientTransformation) -> Any:
    """
    Compile the function that does one step of training.

    Parameters
    ----------
    optimizer
        The optimizer.

    Returns
    -------
    Callable
        Takes the parts of a `State` but `step`, then the pictures, boxes, classes and weights of a
        `Batch`, and the share of the old averages that stays. It returns the new parts and the
        loss.

    """

    def mistake(
        weights: Weights, statistics: Statistics, shown: Any, targets: tuple[Any, Any, Any]
    ) -> tuple[Any, Statistics]:
        cells = Cells.of(shown.shape[1], shown.shape[2])
        raw, seen = outputs(weights, statistics, shown, is_training=True)
        return loss(flat(raw), cells, *targets), seen

    def step(
        parts: State, shown: Any, boxes: Any, classes: Any, weights: Any, average: Any
    ) -> tuple[State, Any]:
        batch = shown.astype(jnp.float32) / 255.0
        (value, seen), gradient = jax.value_and_grad(mistake, has_aux=True)(
            parts['weights'], parts['statistics'], batch, (boxes, classes, weights)
        )
        changes, optimizer_state = optimizer.update(gradient, parts['optimizer'], parts['weights'])
        trained = optax.apply_updates(parts['weights'], changes)
        statistics = _mixed(parts['statistics'], seen, STATISTICS_AVERAGE)
        after = {
            'weights': trained,
            'statistics': statistics,
            'averaged': _mixed(parts['averaged'], trained, average),
            'averaged_statistics': _mixed(parts['averaged_statistics'], statistics, average),
            'optimizer': optimizer_state,
        }
        return after, value

    return jax.jit(step)


def _mixed(old: Mapping[str, Any], new: Mapping[str, Any], share: Any) -> dict[str, Any]:
    """Return so much of the old numbers, and the rest of the new ones."""
    return {name: share * old[name] + (1.0 - share) * new[name] for name in old}


def mean_precision(
    weights: Weights, statistics: Statistics, validation: list[pictures.Shard]
) -> float:
    """
    Compute the mean average precision at an IoU of 0.5 on some pictures.

    Parameters
    ----------
    weights, statistics
        Those of the network.
    validation
        The pictures and what they show.

    """
    truth, found = [], []
    for shard in validation:
        found += detections(weights, statistics, shard)
        truth += list(shard.labels)
    counted = Counted()
    return mean_average_precision(
        [quality(truth, found, kind, counted) for kind in range(len(CLASSES))]
    )


def _inference(weights: Weights, statistics: Statistics, shown: Any) -> Any:
    """Return the outputs of all cells."""
    return flat(outputs(weights, statistics, shown.astype(jnp.float32) / 255.0)[0])


_inferred = jax.jit(_inference)


def detections(
    weights: Weights, statistics: Statistics, shard: pictures.Shard
) -> list[Detections]:
    """
    Detect things in the pictures of a shard.

    Parameters
    ----------
    weights, statistics
        Those of the network.
    shard
        The pictures (n, 240, 320, 3).

    Returns
    -------
    list of Detections
        For each picture, with boxes in its pixels.

    """
    cells, found = Cells.of(HEIGHT_PX, WIDTH_PX), []
    rows = letterboxed(shard.colors[0])[1]
    for first in range(0, len(shard.colors), _AT_ONCE):
        shown = stacked(list(shard.colors[first : first + _AT_ONCE]))
        raw = np.asarray(_inferred(weights, statistics, shown))
        boxes = corners(decoded(np, raw[..., :4], cells)) - np.array([0, rows, 0, rows], 'f4')
        scores = 1.0 / (1.0 + np.exp(-raw[..., 4:]))
        found += [suppressed(each, score, 0.03, 0.6) for each, score in zip(boxes, scores)]
    return found


if __name__ == '__main__':
    main()
