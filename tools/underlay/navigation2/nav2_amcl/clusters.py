# SPDX-License-Identifier: Apache-2.0
"""Pose estimate: the heaviest cluster of particles, its mean and covariance."""

from __future__ import annotations

from dataclasses import dataclass
import math

from nav2_amcl.motion_models import wrapped
from nav2_amcl.occupancy_map import FloatArray
from nav2_amcl.resampling import BIN_COUNT, bin_keys, bins_of
import numpy as np
import numpy.typing as npt

__all__ = ['Cluster', 'best_cluster', 'find_clusters']


@dataclass(frozen=True)
class Cluster:
    """
    Cluster of adjacent particles.

    `pose` is their mean x, y (m) and yaw (rad), `covariance` the (3, 3) matrix of these, `weight`
    their share of the weight of all particles.
    """

    pose: tuple[float, float, float]
    covariance: FloatArray
    weight: float


def find_clusters(particles: FloatArray) -> npt.NDArray[np.intp]:
    """
    Label clusters of particles: those in histogram bins that touch, also at edges and corners.

    Parameters
    ----------
    particles
        (N, 3) array of x, y (m) and yaw (rad).

    Returns
    -------
    (N,) labels from 0.

    """
    bins = bins_of(particles)
    _, first, inverse = np.unique(bin_keys(bins), return_index=True, return_inverse=True)
    labels = _connected(bins[first])
    chosen: npt.NDArray[np.intp] = np.unique(labels, return_inverse=True)[1][inverse.ravel()]
    return chosen


def _connected(bins: npt.NDArray[np.int64]) -> npt.NDArray[np.intp]:
    """Label the (K, 3) bins by connected component."""
    base = bins - bins.min(axis=0) + 1
    height = int(base[:, 1].max()) + 2
    heading = bins[:, 2]
    keys = (base[:, 0] * height + base[:, 1]) * BIN_COUNT + heading
    order = np.argsort(keys)
    ranked = keys[order]
    pairs = [
        _neighbours(base, heading, height, ranked, order, step)
        for step in np.ndindex(3, 3, 3)
        if step > (1, 1, 1)  # each pair once
    ]
    labels = np.arange(len(bins))
    one, other = (np.concatenate(ends) for ends in zip(*pairs))
    while True:  # each label becomes the minimum of its neighbours, and of that one's label
        lowest = labels.copy()
        np.minimum.at(lowest, one, labels[other])
        np.minimum.at(lowest, other, labels[one])
        lowest = lowest[lowest]
        if np.array_equal(lowest, labels):
            return labels
        labels = lowest


def _neighbours(
    base: npt.NDArray[np.int64],
    heading: npt.NDArray[np.int64],
    height: int,
    ranked: npt.NDArray[np.int64],
    order: npt.NDArray[np.intp],
    step: tuple[int, ...],
) -> tuple[npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Find adjacent bins in a direction: their indices, and those of their neighbours."""
    turned = (heading + step[2] - 1) % BIN_COUNT
    wanted = ((base[:, 0] + step[0] - 1) * height + base[:, 1] + step[1] - 1) * BIN_COUNT + turned
    place = np.minimum(np.searchsorted(ranked, wanted), len(ranked) - 1)
    found = np.flatnonzero(ranked[place] == wanted)
    return found, order[place[found]]


def best_cluster(particles: FloatArray, weights: FloatArray) -> Cluster:
    """
    Find the heaviest cluster of weighted particles, with its mean and covariance.

    Parameters
    ----------
    particles, weights
        (N, 3) and (N,) arrays; the sum of the weights is 1.

    """
    labels = find_clusters(particles)
    sums = np.bincount(labels, weights)
    chosen = labels == int(np.argmax(sums))
    total = float(sums.max())
    share = weights[chosen] / total if total > 0.0 else np.full(chosen.sum(), 1.0 / chosen.sum())
    x, y, yaw = particles[chosen].T
    cos, sin = float(share @ np.cos(yaw)), float(share @ np.sin(yaw))
    mean = float(share @ x), float(share @ y), math.atan2(sin, cos)
    errors = np.stack((x - mean[0], y - mean[1], wrapped(yaw - mean[2])))
    return Cluster(mean, (errors * share) @ errors.T, total)
