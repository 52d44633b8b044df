# SPDX-License-Identifier: Apache-2.0
"""Ray casting from one point."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from humanoid_simulation.camera.painter import FAR_M, HIDDEN_GROUP, SEEN_GROUPS
import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_MOST_SHELLS = 8
"""Maximum number of nested geoms that a camera may be inside of."""


def see_all(model: mujoco.MjModel) -> None:
    """
    Make rays hit all geoms of a model, including those that do not collide.

    `mj_multiRay` culls bodies by bounding boxes of their colliding geoms and would miss geoms
    beside them that are only visible.

    Parameters
    ----------
    model
        A model that is used for ray casting only; its bounding volumes are disabled.

    """
    model.body_bvhadr[:] = -1


@dataclass(frozen=True, eq=False)
class Hits:
    """First hit of each of n rays."""

    geoms: NDArray[np.int32]
    """(n,) -1 where a ray hits nothing"""
    distances_m: Array
    """(n,) infinite where a ray hits nothing"""
    points: Array
    """(n, 3) in the world; the start where a ray hits nothing"""
    normals: Array
    """(n, 3) of the surfaces, in the world"""


def cast_rays(model: mujoco.MjModel, data: mujoco.MjData, start: Array, rays: Array) -> Hits:
    """
    Cast rays from one point at the visible geoms.

    Geoms that the point is inside of are skipped, as OpenGL culls back faces.

    Parameters
    ----------
    model, data
        The world and its state; the model must not be shared: geoms are hidden meanwhile.
    start
        Where the rays start (3,), in m in the world frame.
    rays
        Their unit vectors (n, 3), in the world frame.

    """
    left_out = _beside(model, data, start, rays)
    for _ in range(_MOST_SHELLS):
        with _hidden(model, left_out):
            hits = _cast(model, data, start, rays)
        leaves = (hits.geoms >= 0) & (np.sum(hits.normals * rays, axis=1) > 1e-9)
        if not leaves.any():
            break
        left_out = np.union1d(left_out, hits.geoms[leaves])
    return hits


def _beside(
    model: mujoco.MjModel, data: mujoco.MjData, start: Array, rays: Array
) -> NDArray[np.int32]:
    """Find the ids of geoms whose bounding spheres are outside the cone around all rays."""
    axis = rays.mean(axis=0)
    axis = axis / max(float(np.linalg.norm(axis)), 1e-9)
    opening_rad = np.arccos(np.clip(np.min(rays @ axis), -1.0, 1.0))
    away_m = data.geom_xpos - start
    distance_m = np.maximum(np.linalg.norm(away_m, axis=1), 1e-9)
    size_rad = np.arcsin(np.minimum(model.geom_rbound / distance_m, 1.0))
    angle_rad = np.arccos(np.clip(away_m @ axis / distance_m, -1.0, 1.0))
    is_around = (model.geom_rbound >= distance_m) | (model.geom_rbound <= 0.0)
    outside = (angle_rad - size_rad > opening_rad) & ~is_around
    return np.flatnonzero(outside).astype(np.int32)


def _cast(model: mujoco.MjModel, data: mujoco.MjData, start: Array, rays: Array) -> Hits:
    """Cast the rays at all geoms that are not hidden."""
    count = len(rays)
    geoms = np.empty(count, dtype=np.int32)
    distances_m = np.empty(count)
    normals = np.empty(3 * count)
    mujoco.mj_multiRay(
        model, data, start, rays.ravel(), SEEN_GROUPS, True, -1,
        geoms, distances_m, normals, count, FAR_M * 2.0,
    )  # fmt: skip
    hit = geoms >= 0
    points = start + np.where(hit, distances_m, 0.0)[:, None] * rays
    return Hits(geoms, np.where(hit, distances_m, np.inf), points, normals.reshape(-1, 3))


@contextmanager
def _hidden(model: mujoco.MjModel, geoms: NDArray[np.int32]) -> Iterator[None]:
    """Hide geoms from rays for the duration of a `with` block."""
    groups = model.geom_group[geoms]
    model.geom_group[geoms] = HIDDEN_GROUP
    try:
        yield
    finally:
        model.geom_group[geoms] = groups
