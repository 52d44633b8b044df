# SPDX-License-Identifier: Apache-2.0
"""Noise of colour and depth images."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_simulation.camera.painter import Color, Depth
import numpy as np


@dataclass(frozen=True)
class PictureNoise:
    """Standard deviations of the noise of pixels, which is independent for each pixel."""

    color: float = 0.0
    """Of red, green and blue, on a scale of 0 to 255."""
    depth_1_m: float = 0.0
    """Of the depth in metres at a distance of 1 m. It grows with the square of the distance, as
    for cameras that triangulate (stereo or structured light)."""
    seed: int = 0


class PictureNoiseSource:
    """
    Adds Gaussian noise to images, different each time.

    Parameters
    ----------
    noise
        Standard deviations of pixels, and the seed: the same one gives the same sequence.

    """

    def __init__(self, noise: PictureNoise) -> None:
        self._noise = noise
        self._random = np.random.default_rng(noise.seed)

    def spoil(self, color: Color | None, depth: Depth | None) -> None:
        """
        Add Gaussian noise to colour and depth images in place.

        Depth pixels where nothing is seen (infinite) stay as they are.

        Parameters
        ----------
        color, depth
            The images, see `Color` and `Depth`; None is skipped.

        """
        if color is not None and self._noise.color > 0.0:
            errors = self._random.standard_normal(color.shape, np.float32) * self._noise.color
            color[:] = np.clip(np.rint(color + errors), 0, 255)
        if depth is not None and self._noise.depth_1_m > 0.0:
            errors = self._random.standard_normal(depth.shape, np.float32) * self._noise.depth_1_m
            seen = np.isfinite(depth)
            depth[seen] = np.maximum(depth[seen] + errors[seen] * depth[seen] ** 2, 0.0)
