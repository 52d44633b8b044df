# SPDX-License-Identifier: Apache-2.0
"""What the images of a camera are, what renders them, and their noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

NEAR_M = 0.02
FAR_M = 100.0
HIDDEN_GROUP = 3
"""Geoms of this group and those above it only collide; they are not rendered."""
SEEN_GROUPS = np.array([group < HIDDEN_GROUP for group in range(6)], dtype=np.uint8)
"""For each geom group, whether rays hit it, in the format of `mj_multiRay`."""

Color = NDArray[np.uint8]
"""(height, width, 3) red, green, blue"""

Depth = NDArray[np.float32]
"""(height, width) metres along the optical axis; infinite where nothing is seen (REP 118)"""

Cloud = NDArray[np.float32]
"""(height, width, 3) points in metres in the optical frame; NaN where nothing is seen"""


class Painter(Protocol):
    """Renderer of the cameras of a model."""

    def draw(
        self, data: mujoco.MjData, camera: int, color: Color | None, depth: Depth | None
    ) -> None:
        """
        Render the images of a camera into the given arrays.

        Parameters
        ----------
        data
            The state, with bodies, cameras and lights placed (`mj_kinematics`, `mj_camlight`).
        camera
            The id of the camera in the model.
        color, depth
            Images of the same size to be filled, see `Color` and `Depth`; None is skipped.

        """

    def close(self) -> None:
        """Release all resources."""


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
