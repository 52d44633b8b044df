# SPDX-License-Identifier: Apache-2.0
"""Add the lights of a scene, for the cameras."""

from __future__ import annotations

from typing import Any

import mujoco

_HORIZON_RGB = (0.75, 0.82, 0.9)
_ZENITH_RGB = (0.35, 0.5, 0.75)


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
