# SPDX-License-Identifier: Apache-2.0
"""
Random colours of homes and things, of which some are held out for evaluation.

Homes for training and for evaluation differ in more than their seed: the colours of walls, floors
and furniture are drawn from interleaved bands of hue, and the tile sizes and the directions of the
light from interleaved bands as well, so that nothing of the surroundings was ever trained on.
"""

from __future__ import annotations

import colorsys

from humanoid_simulation.scene.parts import COLOURS
import numpy as np

TRAINING, HELD_OUT = 'training', 'held_out'
SPLITS = (TRAINING, HELD_OUT)
_BANDS = 8
_COLOURS_OF = {
    'apple': ('red', 'green', 'yellow'),
    'orange': ('orange',),
}
"""The colours of classes that do not come in all of them."""

Rgb = tuple[float, float, float]


def band(generator: np.random.Generator, split: str) -> float:
    """
    Draw a number from 0 to 1, from bands of which every other one is held out.

    Parameters
    ----------
    generator
        The source of random numbers.
    split
        `held_out` for the bands that are; otherwise those of training.

    """
    number = 2 * int(generator.integers(_BANDS // 2)) + (split == HELD_OUT)
    return float((number + generator.uniform(0.05, 0.95)) / _BANDS)


def surface_colour(generator: np.random.Generator, split: str, vivid: float = 0.25) -> Rgb:
    """
    Draw the colour of a wall, a floor or furniture.

    Parameters
    ----------
    generator
        The source of random numbers.
    split
        `training` or `held_out`: the hues differ.
    vivid
        The share of highly saturated colours, 0 to 1.

    Returns
    -------
    float, float, float
        Red, green and blue, 0 to 1.

    """
    saturation = generator.uniform(0.4, 0.9) if generator.random() < vivid else 0.0
    saturation = saturation or generator.beta(1.2, 3.0)
    value = generator.uniform(0.15, 1.0) ** 0.6
    return colorsys.hsv_to_rgb(band(generator, split), saturation, value)


def thing_colour(kind: str, generator: np.random.Generator) -> tuple[str | None, Rgb]:
    """
    Draw the colour of a thing: in half of all cases exactly a named colour, else a variation.

    Parameters
    ----------
    kind
        The class of the thing.
    generator
        The source of random numbers.

    Returns
    -------
    str, (float, float, float)
        The name of the colour, and red, green and blue, 0 to 1.

    """
    names = _COLOURS_OF.get(kind, tuple(COLOURS))
    name = str(generator.choice(names))
    rgb = np.array(COLOURS[name])
    if generator.random() < 0.5:
        rgb = np.clip(rgb * generator.uniform(0.75, 1.2) + generator.normal(0, 0.05, 3), 0, 1)
    return name, (float(rgb[0]), float(rgb[1]), float(rgb[2]))
