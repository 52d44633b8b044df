# SPDX-License-Identifier: Apache-2.0
"""Rendering by ray casting, one ray per pixel, without OpenGL."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from humanoid_simulation.camera.images import (
    Color,
    Depth,
    FAR_M,
    HIDDEN_GROUP,
    see_all,
    SEEN_GROUPS,
)
from humanoid_simulation.camera.pinhole import camera_id, CameraView, pinhole_of
import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_MOST_SHELLS = 8
"""Maximum number of nested geoms that a camera may be inside of."""
_UNSET_RGBA = np.array([0.5, 0.5, 0.5, 1.0], dtype=np.float32)
"""Default colour of a geom: with it, the colour of the material applies."""


class RayPainter:
    """
    Renderer by ray casting: matt surfaces in flat colours, and exact depth.

    The model must not be shared: its bounding volumes are disabled, and some of its geoms are
    hidden during rendering.

    Parameters
    ----------
    model
        The world.
    views
        The cameras that `draw` can render, and the sizes of their images.

    Raises
    ------
    SimulationError
        A view cannot be rendered, see `pinhole_of`.

    """

    def __init__(self, model: mujoco.MjModel, views: Sequence[CameraView]) -> None:
        see_all(model)
        self._model = model
        self._rays = {camera_id(model, view.camera): _unit_rays(model, view) for view in views}
        self._colors = geom_colors(model)
        self._sky = sky_color(model)

    def draw(
        self, data: mujoco.MjData, camera: int, color: Color | None, depth: Depth | None
    ) -> None:
        """
        Render the images of a camera by ray casting.

        Parameters
        ----------
        data, camera, color, depth
            As for `Painter.draw`; the camera is one of the views.

        """
        rays = self._rays[camera]
        turn = data.cam_xmat[camera].reshape(3, 3)
        hits = cast_rays(self._model, data, data.cam_xpos[camera], rays @ turn.T)
        along_m = hits.distances_m * -rays[:, 2]
        is_seen = along_m < FAR_M
        if depth is not None:
            depth[:] = np.where(is_seen, along_m, np.inf).reshape(depth.shape)
        if color is not None:
            lit = self._lit(data, hits, forward=-turn[:, 2])
            shown = np.where(is_seen[:, None], lit, self._sky)
            color[:] = (255.0 * np.clip(shown, 0.0, 1.0)).reshape(color.shape)

    def close(self) -> None:
        """Release nothing: there are no resources besides memory."""

    def _lit(self, data: mujoco.MjData, hits: Hits, forward: Array) -> Array:
        """Compute the lit colour at each hit, (n, 3), in which 1 is full brightness."""
        light = brightness(self._model, data, hits.points, hits.normals, forward)
        return self._colors[hits.geoms] * light


def _unit_rays(model: mujoco.MjModel, view: CameraView) -> Array:
    """Compute the unit rays of all pixels, (n, 3), in MuJoCo's camera frame: -z forward, y up."""
    rays = pinhole_of(model, view).rays().reshape(-1, 3) * (1.0, -1.0, -1.0)
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))


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


def geom_colors(model: mujoco.MjModel) -> Array:
    """
    Determine one flat colour for each geom; a texture contributes its mean colour.

    Parameters
    ----------
    model
        The world.

    Returns
    -------
    Array
        Red, green and blue (ngeom, 3), 0 to 1.

    """
    colors = np.array(model.geom_rgba[:, :3], dtype=np.float64)
    for geom, material in enumerate(model.geom_matid):
        if material >= 0:
            if np.array_equal(model.geom_rgba[geom], _UNSET_RGBA):
                colors[geom] = model.mat_rgba[material, :3]
            colors[geom] *= _mean_texture(model, _texture_of(model, material))
    return colors


def sky_color(model: mujoco.MjModel) -> Array:
    """
    Determine the background colour: the mean of the skybox, or black without one.

    Parameters
    ----------
    model
        The world.

    Returns
    -------
    Array
        Red, green and blue (3,), 0 to 1.

    """
    kinds = list(model.tex_type)
    if mujoco.mjtTexture.mjTEXTURE_SKYBOX in kinds:
        return _mean_texture(model, kinds.index(mujoco.mjtTexture.mjTEXTURE_SKYBOX))
    return np.zeros(3)


def brightness(
    model: mujoco.MjModel, data: mujoco.MjData, points: Array, normals: Array, forward: Array
) -> Array:
    """
    Compute the light on matt surfaces, by Lambert's law without shadows.

    Parameters
    ----------
    model, data
        The world, and its state with the lights placed (`mj_camlight`).
    points, normals
        Points on the surfaces (n, 3) in m, and their unit normals (n, 3), in the world frame.
    forward
        Unit vector (3,) along which the camera looks and the headlight shines, in the world frame.

    Returns
    -------
    Array
        Red, green and blue light (n, 3), ambient and diffuse; to be multiplied by the colours.

    """
    head = model.vis.headlight
    light = np.zeros_like(points)
    if head.active:
        light += head.ambient + np.outer(_facing(normals, -forward), head.diffuse)
    for number in np.flatnonzero(model.light_active):
        towards = _towards_light(model, data, int(number), points)
        diffuse = np.outer(_facing(normals, towards), model.light_diffuse[number])
        light += model.light_ambient[number] + diffuse
    return light


def _towards_light(
    model: mujoco.MjModel, data: mujoco.MjData, number: int, points: Array
) -> Array:
    """Compute the unit vectors to a light: (3,) if it is directional, else (n, 3)."""
    if model.light_type[number] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL:
        return -np.asarray(data.light_xdir[number], dtype=np.float64)
    towards = data.light_xpos[number] - points
    return np.asarray(towards / np.linalg.norm(towards, axis=1, keepdims=True))


def _facing(normals: Array, towards: Array) -> Array:
    """Compute the cosines between normals (n, 3) and directions to a light, at least 0."""
    return np.asarray(np.maximum(np.sum(normals * towards, axis=1), 0.0))


def _texture_of(model: mujoco.MjModel, material: int) -> int:
    """Return the id of the colour texture of a material, or -1."""
    return int(model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])


def _mean_texture(model: mujoco.MjModel, texture: int) -> Array:
    """Compute the mean colour of a texture, (3,), 0 to 1; white without one."""
    if texture < 0:
        return np.ones(3)
    channels = int(model.tex_nchannel[texture])
    size = int(model.tex_height[texture] * model.tex_width[texture]) * channels
    first = int(model.tex_adr[texture])
    pixels = np.split(model.tex_data, [first, first + size])[1].reshape(-1, channels)
    return np.array(np.broadcast_to(pixels.mean(axis=0)[:3] / 255.0, 3))
