# SPDX-License-Identifier: Apache-2.0
"""Lengths and directions of vectors."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ['Array', 'random_vector', 'unit_vector', 'vector_norm']

Array = NDArray[np.float64]


def vector_norm(data: ArrayLike, axis: int | None = None) -> Any:
    """
    Compute lengths.

    Parameters
    ----------
    data
        A vector, or an array of vectors.
    axis
        The axis along which the vectors are; all together are one vector by default.

    Returns
    -------
    float or numpy.ndarray
        The length, or those along the axis.

    """
    lengths = np.sqrt(np.sum(np.square(np.asarray(data, float)), axis=axis))
    return float(lengths) if np.ndim(lengths) == 0 else lengths


def unit_vector(data: ArrayLike, axis: int | None = None) -> Array:
    """
    Scale vectors to the length 1.

    Parameters
    ----------
    data
        A vector, or an array of vectors.
    axis
        The axis along which the vectors are; all together are one vector by default.

    Returns
    -------
    numpy.ndarray
        The vectors, of the length 1.

    """
    vectors: Array = np.array(data, float)
    lengths = vector_norm(vectors, axis)
    vectors /= lengths if axis is None else np.expand_dims(lengths, axis)
    return vectors


def random_vector(size: int) -> Array:
    """
    Draw numbers from [0, 1).

    Parameters
    ----------
    size
        How many.

    """
    return np.random.default_rng().random(size)
