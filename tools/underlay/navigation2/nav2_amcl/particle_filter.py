# SPDX-License-Identifier: Apache-2.0
"""Adaptive Monte Carlo localisation: a particle filter that tracks the pose of the robot."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_amcl.clusters import best_cluster, Cluster
from nav2_amcl.laser_models import LaserModel
from nav2_amcl.motion_models import MotionModel, MotionNoise, Pose
from nav2_amcl.occupancy_map import FloatArray, OccupancyMap
from nav2_amcl.resampling import draw_systematically, needed_size
from nav2_amcl.scan_projection import Beams
import numpy as np

__all__ = ['FilterOptions', 'ParticleFilter']


_LEAST_EFFECTIVE = 0.02
"""The minimum effective fraction of the particles after a scan."""

_HALVINGS = 10


@dataclass(frozen=True)
class FilterOptions:
    """Limits of the number of particles, and the rates of recovery by random particles."""

    min_particles: int = 500
    max_particles: int = 2000
    kld_error: float = 0.05
    kld_quantile: float = 0.99
    alpha_slow: float = 0.0
    alpha_fast: float = 0.0
    free_cell_step: int = 1
    global_factor: int = 10
    """
    How many times `max_particles` are drawn for a global initialisation, before the first scan.
    """


class ParticleFilter:
    """
    Particle filter, updated by odometry and scans.

    Source: Thrun, Burgard, Fox: Probabilistic Robotics, 2005, table 8.3 (augmented MCL), with
    KLD sampling (D. Fox 2003). Its `options` may be replaced at any time.

    Parameters
    ----------
    options
        Sizes and recovery.
    random
        The random number generator.

    """

    def __init__(self, options: FilterOptions, random: np.random.Generator) -> None:
        self.options = options
        self._random = random
        self.particles: FloatArray = np.zeros((1, 3))
        """(N, 3) array of x, y (m) and yaw (rad) in the frame of the map."""
        self.weights: FloatArray = np.ones(1)
        """(N,) array with the sum 1."""
        self._slow = self._fast = 0.0

    def start_at(self, pose: Pose, covariance: FloatArray) -> None:
        """
        Draw all particles around a pose.

        Parameters
        ----------
        pose
            x, y (m) and yaw (rad).
        covariance
            The (3, 3) matrix of these; negative eigenvalues count as zero.

        """
        values, vectors = np.linalg.eigh(0.5 * (covariance + covariance.T))
        spread = vectors * np.sqrt(np.maximum(values, 0.0))
        drawn = self._random.normal(size=(self.options.max_particles, 3))
        self._replace(np.asarray(pose) + drawn @ spread.T)

    def start_anywhere(self, grid: OccupancyMap) -> None:
        """
        Draw particles from the whole free space of a map.

        There are more than `max_particles` until the next `resample`, so that some are close
        enough to the robot for the first scan to match.

        Parameters
        ----------
        grid
            The map.

        """
        count = self.options.max_particles * self.options.global_factor
        step = self.options.free_cell_step
        self._replace(grid.sample_free_poses(count, self._random, step))

    def move(self, model: MotionModel, before: Pose, after: Pose, noise: MotionNoise) -> None:
        """
        Move the particles by a motion measured by odometry.

        Parameters
        ----------
        model
            The motion model, which samples the motion of each particle.
        before, after
            The base in the frame of odometry: x, y (m) and yaw (rad).
        noise
            The noise of odometry.

        """
        self.particles = model.move(self.particles, before, after, noise, self._random)

    def weigh(self, model: LaserModel, beams: Beams) -> None:
        """
        Weight the particles by the likelihood of a scan; an uninformative scan changes nothing.

        Parameters
        ----------
        model
            The laser model, which compares the scan with the map.
        beams
            The scan, as seen from the base.

        """
        logs = model.log_likelihoods(self.particles, beams)
        if not logs.any():
            return
        highest = float(logs.max())
        average = float(np.log(self.weights @ np.exp(logs - highest))) + highest
        # The averages are per beam, so that their ratio means the same for all scans.
        self._follow(float(np.exp(average / max(len(beams.ranges), 1))))
        self.weights = _weighed(self.weights, logs - highest)

    def resample(self, grid: OccupancyMap) -> None:
        """
        Resample the particles by their weights; KLD sampling sets their number.

        Parameters
        ----------
        grid
            The map; the fraction `recovery_share` of the particles is drawn from its free space.

        """
        options, random = self.options, self._random
        limits = options.min_particles, options.max_particles
        count = needed_size(
            self.particles, self.weights, limits, options.kld_error, options.kld_quantile, random
        )
        drawn = self.particles[draw_systematically(self.weights, count, random)]
        lost = random.random(count) < self.recovery_share
        if lost.any():
            fresh = grid.sample_free_poses(int(lost.sum()), random, options.free_cell_step)
            drawn[lost] = fresh
        self.particles, self.weights = drawn, np.full(count, 1.0 / count)

    @property
    def recovery_share(self) -> float:
        """Return the fraction of particles that `resample` draws from the whole map."""
        if self._slow <= 0.0 or self.options.alpha_slow <= 0.0:
            return 0.0
        return max(0.0, 1.0 - self._fast / self._slow)

    def estimate(self) -> Cluster:
        """Estimate the pose of the robot: the heaviest cluster."""
        return best_cluster(self.particles, self.weights)

    def _follow(self, likelihood: float) -> None:
        """Update the slow and fast averages of the likelihood; the fast one drops on a failure."""
        options = self.options
        if self._slow <= 0.0:
            self._slow = self._fast = likelihood
        self._slow += options.alpha_slow * (likelihood - self._slow)
        self._fast += options.alpha_fast * (likelihood - self._fast)

    def _replace(self, particles: FloatArray) -> None:
        self.particles = particles
        self.weights = np.full(len(particles), 1.0 / len(particles))
        self._slow = self._fast = 0.0


def _weighed(weights: FloatArray, logs: FloatArray) -> FloatArray:
    """
    Multiply weights by likelihoods, normalise, and keep the effective sample size sufficient.

    Where few particles get all the weight, they are too sparse for the scan, as after a global
    initialisation: the likelihoods are then tempered by the power below 1 that yields an effective
    fraction of `_LEAST_EFFECTIVE`.
    """
    power = 1.0
    found = _normalised(weights, logs)
    if _effective_share(found) >= _LEAST_EFFECTIVE:
        return found
    low = 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + power)
        found = _normalised(weights, middle * logs)
        if _effective_share(found) < _LEAST_EFFECTIVE:
            power = middle
        else:
            low = middle
    return _normalised(weights, low * logs)


def _normalised(weights: FloatArray, logs: FloatArray) -> FloatArray:
    scaled: FloatArray = weights * np.exp(logs)
    scaled /= scaled.sum()
    return scaled


def _effective_share(weights: FloatArray) -> float:
    return 1.0 / (len(weights) * float(weights @ weights))
