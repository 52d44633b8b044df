# SPDX-License-Identifier: Apache-2.0
"""Colours and lighting of surfaces that are rendered without OpenGL."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_UNSET_RGBA = np.array([0.5, 0.5, 0.5, 1.0], dtype=np.float32)
"""Default colour of a geom: with it, the colour of the material applies."""


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
