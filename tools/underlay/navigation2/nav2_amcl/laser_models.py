# SPDX-License-Identifier: Apache-2.0
"""Laser models, which compute the likelihood of a scan: likelihood field and beam model."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Protocol

from nav2_amcl.occupancy_map import FloatArray, OccupancyMap, RayCaster
from nav2_amcl.scan_projection import Beams
import numpy as np
import numpy.typing as npt

__all__ = [
    'LASER_MODELS',
    'BeamModel',
    'BeamSkipping',
    'LaserModel',
    'LaserNoise',
    'LikelihoodField',
    'LikelihoodFieldProb',
    'make_laser_model',
]

SingleArray = npt.NDArray[np.float32]
_INDEPENDENT_BEAMS = 20.0
"""Errors of adjacent beams are correlated: a scan counts as at most this many beams."""


@dataclass(frozen=True)
class LaserNoise:
    """
    Parameters of the measurement mixture model.

    Weights of a noisy hit, of an unmapped obstacle in front, of no return, and of a random
    reading; the standard deviation of a hit in m, the decay of unmapped obstacles in 1/m, and the
    maximum obstacle distance in m of the likelihood field.
    """

    z_hit: float = 0.5
    z_short: float = 0.05
    z_max: float = 0.05
    z_rand: float = 0.5
    sigma_hit_m: float = 0.2
    lambda_short: float = 0.1
    max_distance_m: float = 2.0


@dataclass(frozen=True)
class BeamSkipping:
    """
    Beam skipping: ignores beams with which most particles disagree, such as those that hit people.

    A particle agrees if the beam ends within `distance_m` of an obstacle. Beams with which less
    than the fraction `threshold` agrees are skipped, unless these are more than the fraction
    `error_threshold` of all beams: then the particles are wrong, not the beams.
    """

    distance_m: float = 0.5
    threshold: float = 0.3
    error_threshold: float = 0.9


class LaserModel(Protocol):
    """Interface of laser models, which compute the likelihood of a scan."""

    def log_likelihoods(self, particles: FloatArray, beams: Beams) -> FloatArray:
        """
        Compute the log-likelihood of a scan for each particle.

        Parameters
        ----------
        particles
            (N, 3) array of x, y (m) and yaw (rad) of the base in the frame of the map.
        beams
            The scan, projected into the plane of the base.

        Returns
        -------
        (N,) array; zeros if the scan is uninformative.

        """


def _tempered(log_likelihoods: npt.NDArray[np.floating], beams: int) -> FloatArray:
    """Sum the log-likelihoods (N, B), as if at most `_INDEPENDENT_BEAMS` were independent."""
    total: FloatArray = log_likelihoods.sum(axis=1, dtype=np.float64)
    return total * min(1.0, _INDEPENDENT_BEAMS / max(beams, 1))


class LikelihoodField:
    """
    Likelihood field model: scores the endpoint of each beam by its distance to obstacles.

    Source: Thrun, Burgard, Fox: Probabilistic Robotics, 2005, table 6.3. Beams without return are
    ignored. Beams are treated as partly dependent, which preserves particle diversity.

    Parameters
    ----------
    grid
        The map.
    noise
        The noise model; `z_hit`, `z_rand`, `sigma_hit_m`, `max_distance_m`
        are used.

    """

    def __init__(self, grid: OccupancyMap, noise: LaserNoise) -> None:
        self._grid, self._noise = grid, noise
        self._max_range_m = 0.0
        self._table: SingleArray = np.zeros(0, np.float32)

    def log_likelihoods(self, particles: FloatArray, beams: Beams) -> FloatArray:
        """
        Compute the log-likelihood of a scan for each particle.

        Parameters
        ----------
        particles, beams
            As for `LaserModel.log_likelihoods`.

        Returns
        -------
        numpy.ndarray
            Log-likelihoods (N,), as of at most 20 independent beams.

        """
        points = beams.points()
        return _tempered(self._rated(particles, points, beams.max_range_m), len(points))

    def _rated(self, particles: FloatArray, points: FloatArray, max_range_m: float) -> SingleArray:
        """Compute the (N, B) log-likelihood of each beam."""
        if max_range_m != self._max_range_m:
            self._max_range_m, self._table = max_range_m, self._make_table(max_range_m)
        return self._table[self._cells(particles, points)]

    def _cells(self, particles: FloatArray, points: FloatArray) -> npt.NDArray[np.int32]:
        """Compute the (N, B) indices of beam endpoints in tables with a border of one cell."""
        grid = self._grid
        start = grid.to_grid(particles[:, :2]) + 1.0
        yaw = particles[:, 2] - grid.origin[2]
        cos, sin = np.cos(yaw) / grid.resolution, np.sin(yaw) / grid.resolution
        basis = np.concatenate((points.T, np.ones((1, len(points))))).astype(np.float32)
        rows, columns = grid.cells.shape
        x = np.stack((cos, -sin, start[:, 0]), axis=1).astype(np.float32) @ basis
        y = np.stack((sin, cos, start[:, 1]), axis=1).astype(np.float32) @ basis
        np.clip(x, 0.0, columns + 1.0, out=x)
        np.clip(y, 0.0, rows + 1.0, out=y)
        index = y.astype(np.int32)
        index *= np.int32(columns + 2)
        index += x.astype(np.int32)
        return index

    def _make_table(self, max_range_m: float) -> SingleArray:
        """Precompute the log-likelihood of a beam that ends in each cell, with a border."""
        noise = self._noise
        far = np.float32(noise.max_distance_m)
        distance = np.pad(np.minimum(self._grid.distances, far), 1, constant_values=far)
        near = np.exp(-0.5 * (distance / max(noise.sigma_hit_m, 1e-3)) ** 2)
        likelihood = noise.z_hit * near + max(noise.z_rand / max_range_m, 1e-6)
        return np.log(likelihood).astype(np.float32).ravel()


class LikelihoodFieldProb(LikelihoodField):
    """
    Likelihood field model with independent beams and beam skipping.

    Parameters
    ----------
    grid, noise
        The map, and the parameters of the laser.
    skipping
        The parameters of beam skipping; no beams are skipped if None.

    """

    def __init__(
        self, grid: OccupancyMap, noise: LaserNoise, skipping: BeamSkipping | None = None
    ) -> None:
        super().__init__(grid, noise)
        self._skipping = skipping
        self._distances = np.pad(grid.distances, 1, constant_values=np.inf).ravel()

    def log_likelihoods(self, particles: FloatArray, beams: Beams) -> FloatArray:
        """
        Compute the log-likelihood of a scan for each particle, without skipped beams.

        Parameters
        ----------
        particles, beams
            As for `LaserModel.log_likelihoods`.

        Returns
        -------
        numpy.ndarray
            Log-likelihoods (N,), as of independent beams.

        """
        points = beams.points()
        if self._skipping is not None and len(points):
            near = self._distances[self._cells(particles, points)] < self._skipping.distance_m
            kept = near.mean(axis=0) >= self._skipping.threshold
            if 1.0 - kept.mean() < self._skipping.error_threshold:
                points = points[kept]
        rated = self._rated(particles, points, beams.max_range_m)
        total: FloatArray = rated.sum(axis=1, dtype=np.float64)
        return total


class BeamModel:
    """
    Beam model: compares the range of each beam with the expected one, by ray casting.

    Source: Thrun, Burgard, Fox: Probabilistic Robotics, 2005, table 6.1. Beams are treated as
    partly dependent, which preserves particle diversity.

    Parameters
    ----------
    grid
        The map.
    noise
        The noise model.

    """

    def __init__(self, grid: OccupancyMap, noise: LaserNoise) -> None:
        self._caster, self._noise = RayCaster(grid), noise

    def log_likelihoods(self, particles: FloatArray, beams: Beams) -> FloatArray:
        """
        Compute the log-likelihood of a scan for each particle, by ray casting.

        Parameters
        ----------
        particles, beams
            As for `LaserModel.log_likelihoods`.

        Returns
        -------
        numpy.ndarray
            Log-likelihoods (N,), as of at most 20 independent beams.

        """
        if not len(beams.ranges):
            return np.zeros(len(particles))
        noise, far = self._noise, np.float32(beams.max_range_m)
        cos, sin = np.cos(particles[:, 2]), np.sin(particles[:, 2])
        origins = particles[:, :2].copy()
        origins[:, 0] += cos * beams.origin[0] - sin * beams.origin[1]
        origins[:, 1] += sin * beams.origin[0] + cos * beams.origin[1]
        angles = particles[:, 2, None] + beams.angles[None, :]
        expected = self._caster.cast(origins[:, None, :], angles, float(far))
        seen = beams.ranges.astype(np.float32)
        error = seen - np.minimum(expected, far).astype(np.float32)
        sigma = np.float32(max(noise.sigma_hit_m, 1e-3))
        likelihood = np.float32(noise.z_hit) * np.exp(np.float32(-0.5) * (error / sigma) ** 2)
        short = noise.z_short * noise.lambda_short * np.exp(-noise.lambda_short * seen)
        likelihood += np.where(error < 0.0, short.astype(np.float32), np.float32(0.0))
        likelihood += np.where(beams.hits, noise.z_rand / far, noise.z_max).astype(np.float32)
        return _tempered(np.log(np.maximum(likelihood, np.float32(1e-9))), len(seen))


LASER_MODELS = ('likelihood_field', 'likelihood_field_prob', 'beam')
"""The valid values of `laser_model_type`."""


def make_laser_model(
    name: str, grid: OccupancyMap, noise: LaserNoise, skipping: BeamSkipping | None = None
) -> LaserModel:
    """
    Make a laser model by its name.

    Parameters
    ----------
    name
        One of `LASER_MODELS`; others make a likelihood field.
    grid
        The map.
    noise
        The noise model.
    skipping
        The parameters of beam skipping in likelihood_field_prob, none if None; the other models
        ignore it.

    Raises
    ------
    ValueError
        The standard deviation of a hit is not finite.

    """
    if not math.isfinite(noise.sigma_hit_m):
        raise ValueError('sigma_hit must be finite')
    if name == 'beam':
        return BeamModel(grid, noise)
    if name == 'likelihood_field_prob':
        return LikelihoodFieldProb(grid, noise, skipping)
    return LikelihoodField(grid, noise)
