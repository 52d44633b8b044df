# SPDX-License-Identifier: Apache-2.0
"""Generate the textures of surface finishes."""

from __future__ import annotations

from humanoid_simulation.scene.parts import Finish
import numpy as np
from numpy.typing import NDArray

Picture = NDArray[np.uint8]
EDGE_PX = 128
_PLANKS = 4
_GROUT = 0.04


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
