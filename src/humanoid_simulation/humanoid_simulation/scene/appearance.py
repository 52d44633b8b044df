# SPDX-License-Identifier: Apache-2.0
"""How a scene looks: the textures of its surfaces, and its lights."""

from __future__ import annotations

from typing import Any

from humanoid_simulation.scene.parts import Finish
import mujoco
import numpy as np
from numpy.typing import NDArray

Picture = NDArray[np.uint8]
EDGE_PX = 128
_PLANKS = 4
_GROUT = 0.04
_HORIZON_RGB = (0.75, 0.82, 0.9)
_ZENITH_RGB = (0.35, 0.5, 0.75)


def picture_of(finish: Finish) -> Picture:
    """
    Generate one period of the pattern of a finish; the result is deterministic.

    Parameters
    ----------
    finish
        The pattern and its colours.

    Returns
    -------
    Picture
        Red, green and blue (EDGE_PX, EDGE_PX, 3), 0 to 255.

    """
    share = _SHARES[finish.pattern]()
    first, second = np.array(finish.first_rgb), np.array(finish.second_rgb)
    colours = first + (second - first) * share[..., None]
    return np.asarray(np.clip(255.0 * colours, 0.0, 255.0).round(), dtype=np.uint8)


def _axes() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the coordinates of all pixels, across and down, 0 to 1."""
    at = (np.arange(EDGE_PX) + 0.5) / EDGE_PX
    across, down = np.meshgrid(at, at)
    return across, down


def _tiles() -> NDArray[np.float64]:
    """Return 2 x 2 tiles in alternating colours, with grout."""
    across, down = _axes()
    is_second = ((across * 2).astype(int) + (down * 2).astype(int)) % 2
    in_joint = np.minimum((across * 2) % 1.0, (down * 2) % 1.0) < _GROUT
    return np.where(in_joint, 0.5, is_second.astype(float))


def _planks() -> NDArray[np.float64]:
    """Return planks along x with butt joints and grain, each in its own shade."""
    across, down = _axes()
    random = np.random.default_rng(1)
    row = (down * _PLANKS).astype(int)
    shade = random.permutation(np.linspace(0.0, 0.8, _PLANKS))[row]
    grain = random.random((EDGE_PX, 1)) * np.ones((1, EDGE_PX))
    joint = (across + 0.37 * row) % 1.0 < 0.012
    seam = (down * _PLANKS) % 1.0 < 0.05
    return np.where(joint | seam, 1.2, shade + 0.2 * grain)


def _stripes() -> NDArray[np.float64]:
    """Return stripes that run along y: upright on a wall."""
    across, _ = _axes()
    return (across >= 0.5).astype(float)


def _carpet() -> NDArray[np.float64]:
    """Return random specks."""
    return np.random.default_rng(2).random((EDGE_PX, EDGE_PX))


def _plain() -> NDArray[np.float64]:
    """Return the first colour only."""
    return np.zeros((EDGE_PX, EDGE_PX))


_SHARES = {
    'plain': _plain,
    'tiles': _tiles,
    'planks': _planks,
    'stripes': _stripes,
    'carpet': _carpet,
}
"""The generators of the share of the second colour in each pixel, by pattern."""


def add_lighting(world: Any, is_indoors: bool = False) -> None:
    """
    Add a sun, a sky and a headlight with ambient light to a model specification.

    Parameters
    ----------
    world
        The `mujoco.MjSpec` to add to.
    is_indoors
        Whether to add more ambient light, as rooms need it.

    """
    world.worldbody.add_light(
        name='sun',
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
        pos=(0.0, 0.0, 6.0),
        dir=(-0.3, 0.2, -1.0),
        diffuse=(0.5, 0.5, 0.5),
        specular=(0.1, 0.1, 0.1),
    )
    world.add_texture(
        name='sky',
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=_ZENITH_RGB,
        rgb2=_HORIZON_RGB,
        width=64,
        height=64 * 6,
    )
    head = world.visual.headlight
    ambient = 0.5 if is_indoors else 0.35
    head.ambient, head.diffuse, head.specular = (ambient,) * 3, (0.3,) * 3, (0.0,) * 3
