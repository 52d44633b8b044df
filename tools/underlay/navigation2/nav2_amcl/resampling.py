# SPDX-License-Identifier: Apache-2.0
"""Resampling: the number of particles needed, and their selection."""

from __future__ import annotations

import math
from statistics import NormalDist

from nav2_amcl.occupancy_map import FloatArray
import numpy as np
import numpy.typing as npt

__all__ = ['bins_of', 'draw_systematically', 'kld_size', 'needed_size']

BIN_M = 0.5
"""The side length of a position bin, in m."""

BIN_COUNT = 36
"""The number of heading bins."""


def bins_of(particles: FloatArray) -> npt.NDArray[np.int64]:
    """
    Compute the histogram bins of particles.

    Parameters
    ----------
    particles
        (N, 3) array of x, y (m) and yaw (rad).

    Returns
    -------
    (N, 3) array of integers for x, y and yaw, the last from 0 to `BIN_COUNT` - 1.

    """
    bins = np.empty(particles.shape, np.int64)
    bins[:, :2] = np.floor(particles[:, :2] / BIN_M)
    turns = particles[:, 2] / (2.0 * math.pi)
    bins[:, 2] = np.floor((turns - np.floor(turns)) * BIN_COUNT)
    bins[:, 2] %= BIN_COUNT
    return bins


def bin_keys(bins: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """
    Compute a key for each bin of a histogram.

    Parameters
    ----------
    bins
        Bins (N, 3), as of `bins_of`; N is at least 1.

    Returns
    -------
    numpy.ndarray
        Keys (N,), equal where the bins are equal.

    """
    first = bins - bins.min(axis=0)
    sizes = first.max(axis=0) + 1
    keys: npt.NDArray[np.int64] = (first[:, 0] * sizes[1] + first[:, 1]) * sizes[2] + first[:, 2]
    return keys


def kld_size(
    occupied_bins: npt.NDArray[np.int64], error: float, quantile: float
) -> npt.NDArray[np.float64]:
    """
    Compute the number of particles needed to represent a distribution (KLD sampling).

    Source: D. Fox: Adapting the Sample Size in Particle Filters Through KLD-Sampling, IJRR 22,
    2003, equation 17.

    Parameters
    ----------
    occupied_bins
        (K,) numbers of bins of the histogram with particles in them.
    error
        The maximum Kullback-Leibler distance to the true distribution.
    quantile
        The probability, below 1, that the distance is not exceeded.

    Returns
    -------
    (K,) numbers of particles; 1 where there is only one bin.

    """
    normal = NormalDist().inv_cdf(min(max(quantile, 0.01), 0.999999))
    freedom = np.maximum(occupied_bins - 1, 1).astype(float)
    part = 2.0 / (9.0 * freedom)
    sizes = freedom / (2.0 * max(error, 1e-6)) * (1.0 - part + np.sqrt(part) * normal) ** 3
    return np.where(occupied_bins <= 1, 1.0, np.ceil(sizes))


def draw_systematically(
    weights: FloatArray, count: int, random: np.random.Generator
) -> npt.NDArray[np.intp]:
    """
    Draw indices with given probabilities by systematic (low-variance) resampling.

    Source: Thrun, Burgard, Fox: Probabilistic Robotics, 2005, table 4.4.

    Parameters
    ----------
    weights
        (N,) weights with the sum 1.
    count
        The number of indices.
    random
        The random number generator.

    Returns
    -------
    (count,) indices in ascending order.

    """
    cumulative = np.cumsum(weights)
    places = (random.random() + np.arange(count)) * (cumulative[-1] / count)
    found = np.searchsorted(cumulative, places, side='right')
    drawn: npt.NDArray[np.intp] = np.minimum(found, len(weights) - 1)
    return drawn


def needed_size(
    particles: FloatArray,
    weights: FloatArray,
    limits: tuple[int, int],
    error: float,
    quantile: float,
    random: np.random.Generator,
) -> int:
    """
    Compute the new number of particles of a weighted set, by KLD sampling.

    Particles are drawn until there are as many as their occupied bins require.

    Parameters
    ----------
    particles, weights
        (N, 3) and (N,) arrays; the sum of the weights is 1.
    limits
        The minimum and the maximum number.
    error, quantile
        See `kld_size`.
    random
        The random number generator.

    """
    low, high = limits
    drawn = random.permutation(draw_systematically(weights, high, random))
    keys = bin_keys(bins_of(particles))[drawn]
    is_new = np.zeros(high, np.int64)
    is_new[np.unique(keys, return_index=True)[1]] = 1
    enough = np.arange(1, high + 1) >= kld_size(np.cumsum(is_new), error, quantile)
    enough[: low - 1] = False
    return int(np.argmax(enough)) + 1 if enough.any() else high
