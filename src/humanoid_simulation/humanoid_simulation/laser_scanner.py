# SPDX-License-Identifier: Apache-2.0
"""Simulated planar laser scanner."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
import math

from humanoid_simulation.camera.images import HIDDEN_GROUP, see_all, SEEN_GROUPS
from humanoid_simulation.errors import named
import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ranges = NDArray[np.float32]


@dataclass(frozen=True)
class ScanPattern:
    """The rays of a full-circle scan, anticlockwise, and its range limits."""

    rays: int = 360
    range_min_m: float = 0.1
    range_max_m: float = 12.0

    @property
    def angle_min_rad(self) -> float:
        """Return the angle of the first ray, which points backwards."""
        return -math.pi

    @property
    def angle_increment_rad(self) -> float:
        """Return the angle from one ray to the next."""
        return 2.0 * math.pi / self.rays

    @property
    def angle_max_rad(self) -> float:
        """Return the angle of the last ray."""
        return self.angle_min_rad + (self.rays - 1) * self.angle_increment_rad

    def directions(self) -> Array:
        """Compute the unit vectors of the rays, (rays, 3), in the frame of the scanner."""
        angles = self.angle_min_rad + np.arange(self.rays) * self.angle_increment_rad
        return np.stack([np.cos(angles), np.sin(angles), np.zeros(self.rays)], axis=1)


@dataclass(frozen=True)
class ScanNoise:
    """Noise of ranges, which is independent for each ray, and dropouts."""

    range_m: float = 0.0
    """Standard deviation of a range."""
    dropout_share: float = 0.0
    """The share of rays without a return, from 0 to 1."""
    seed: int = 0


class LaserScanner:
    """
    A scanner on a link of a robot: it sees what a camera would see, except its own robot.

    All rays of a scan are cast at the same time, in the x-y plane of the link. The model is
    copied: later changes to it have no effect.

    Parameters
    ----------
    model
        The compiled world.
    link
        The name of the link in it, such as `robot/laser`.
    pattern
        The rays.
    noise
        Noise of the ranges.
    number
        Index of the scanner: each has its own noise.

    Raises
    ------
    SimulationError
        The world has no link of that name.

    """

    def __init__(
        self,
        model: mujoco.MjModel,
        link: str,
        pattern: ScanPattern = ScanPattern(),
        noise: ScanNoise = ScanNoise(),
        number: int = 0,
    ) -> None:
        numbers = {model.body(number).name: number for number in range(model.nbody)}
        self._link = named('link', link, numbers)
        self.pattern, self._noise, self._number = pattern, noise, number
        self._directions = pattern.directions()
        roots = model.body_rootid
        own = roots[model.geom_bodyid] == roots[self._link]
        self._seen = (model.geom_group < HIDDEN_GROUP) & ~own
        # A copy, in which geoms that no ray can hit are hidden.
        self._model = copy(model)
        see_all(self._model)
        self._centres_m, self._half_sizes_m = np.split(model.geom_aabb.copy(), 2, axis=1)
        self._is_endless = model.geom_rbound <= 0.0
        self._geoms = np.empty(pattern.rays, dtype=np.int32)
        self._distances_m = np.empty(pattern.rays)

    def sweep(self, data: mujoco.MjData, time_ns: int) -> Ranges:
        """
        Measure the distance along each ray.

        Parameters
        ----------
        data
            A state of the world, with the poses of its bodies computed.
        time_ns
            Its time; the same seed gives the same noise at the same time.

        Returns
        -------
        Ranges
            Ranges in m, (rays,): infinite where nothing is within the range, minus infinity where
            something is too close to be measured, NaN for a ray without a return (REP 117).

        """
        pattern = self.pattern
        distances_m = self._spoiled(self._cast(data), time_ns)
        near, far = distances_m < pattern.range_min_m, distances_m > pattern.range_max_m
        distances_m[near], distances_m[far] = -np.inf, np.inf
        return distances_m.astype(np.float32)

    def _cast(self, data: mujoco.MjData) -> Array:
        """Cast the rays; return their lengths (rays,), infinite where they hit nothing."""
        turn = data.xmat[self._link].reshape(3, 3)
        origin_m = data.xpos[self._link]
        rays = np.ascontiguousarray(self._directions @ turn.T)
        is_met = self._seen & self._meets(data, origin_m, turn[:, 2])
        self._model.geom_group[:] = np.where(is_met, 0, HIDDEN_GROUP)
        mujoco.mj_multiRay(
            self._model, data, origin_m, rays.ravel(), SEEN_GROUPS, True, -1,
            self._geoms, self._distances_m, None, len(rays), 2.0 * self.pattern.range_max_m,
        )  # fmt: skip
        return np.where(self._geoms >= 0, self._distances_m, np.inf)

    def _meets(self, data: mujoco.MjData, origin_m: Array, normal: Array) -> NDArray[np.bool_]:
        """Find the geoms, (ngeom,), whose bounding boxes intersect the plane of the rays."""
        normals = normal @ data.geom_xmat.reshape(-1, 3, 3)
        height_m = (data.geom_xpos - origin_m) @ normal + np.sum(self._centres_m * normals, axis=1)
        reach_m = np.sum(self._half_sizes_m * np.abs(normals), axis=1)
        return np.asarray((np.abs(height_m) <= reach_m) | self._is_endless)

    def _spoiled(self, distances_m: Array, time_ns: int) -> Array:
        """Add noise and dropouts to distances."""
        noise = self._noise
        if noise.range_m <= 0.0 and noise.dropout_share <= 0.0:
            return distances_m
        random = np.random.default_rng([noise.seed, self._number, time_ns])
        distances_m += noise.range_m * random.standard_normal(len(distances_m))
        distances_m[random.random(len(distances_m)) < noise.dropout_share] = np.nan
        return distances_m
