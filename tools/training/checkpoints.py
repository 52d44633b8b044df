# SPDX-License-Identifier: Apache-2.0
"""The state of a training, and its file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
from jax_operations import initial_weights
import numpy as np
import optax

_STORED = ('weights', 'statistics', 'averaged', 'averaged_statistics')

State = dict[str, Any]
"""What training changes: by `_STORED`, `optimizer`, and the number of `step`s done."""


def start(optimizer: optax.GradientTransformation, seed: int) -> State:
    """
    Return the state before the first step.

    Parameters
    ----------
    optimizer
        The optimizer, whose state is part of it.
    seed
        Of the random weights.

    """
    weights, statistics = initial_weights(seed)
    return {
        'weights': weights,
        'statistics': statistics,
        'averaged': weights,
        'averaged_statistics': statistics,
        'optimizer': optimizer.init(weights),
        'step': 0,
    }


def save(path: Path, state: State) -> None:
    """
    Write a checkpoint; the one before stays until this one is complete.

    Parameters
    ----------
    path
        The file, with the suffix .npz.
    state
        The state of the training.

    """
    arrays = {
        f'{part}:{name}': np.asarray(value)
        for part in _STORED
        for name, value in state[part].items()
    }
    for number, leaf in enumerate(jax.tree.leaves(state['optimizer'])):
        arrays[f'optimizer:{number}'] = np.asarray(leaf)
    unfinished = path.with_suffix('.unfinished.npz')
    arrays['step'] = np.array(state['step'])
    np.savez(unfinished, allow_pickle=False, **arrays)
    unfinished.replace(path)


def load(path: Path, optimizer: optax.GradientTransformation, seed: int) -> State:
    """
    Load the state of a checkpoint, or return that before the first step if there is none.

    Parameters
    ----------
    path
        The file of the checkpoint.
    optimizer
        The optimizer, of the same structure as that of the checkpoint.
    seed
        Of the random weights, if there is no checkpoint.

    """
    state = start(optimizer, seed)
    if not path.exists():
        return state
    with np.load(path) as stored:
        for part in _STORED:
            state[part] = {name: stored[f'{part}:{name}'] for name in state[part]}
        leaves, structure = jax.tree.flatten(state['optimizer'])
        state['optimizer'] = structure.unflatten(
            [jnp.asarray(stored[f'optimizer:{number}']) for number in range(len(leaves))]
        )
        state['step'] = int(stored['step'])
    return state
