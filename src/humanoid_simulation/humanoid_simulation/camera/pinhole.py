# SPDX-License-Identifier: Apache-2.0
"""Pinhole camera model without distortion."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_simulation.camera.painter import Cloud, Depth
from humanoid_simulation.errors import SimulationError
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pinhole:
    """
    A pinhole camera with square pixels and its principal point at the image centre.

    The optical frame is that of REP 103: z forward, x right, y down. Integer pixel coordinates
    are the centres of pixels, (0, 0) that of the upper left one.
    """

    width_px: int
    height_px: int
    fovy_rad: float
    """Vertical field of view."""

    def __post_init__(self) -> None:
        """Check the image size and the field of view."""
        if self.width_px < 1 or self.height_px < 1:
            raise SimulationError(
                f'A picture of {self.width_px} x {self.height_px} pixels has nothing to show. '
                'Give the camera at least one pixel in each direction.'
            )
        if not 0.0 < self.fovy_rad < math.pi:
            raise SimulationError(
                f'The vertical field of view of a camera is {self.fovy_rad} rad. '
                'It must be more than 0 and less than pi.'
            )

    @property
    def focal_px(self) -> float:
        """Return the focal length, the same in both directions."""
        return 0.5 * self.height_px / math.tan(0.5 * self.fovy_rad)

    @property
    def centre_px(self) -> tuple[float, float]:
        """Return the coordinates x, y of the principal point."""
        return 0.5 * (self.width_px - 1), 0.5 * (self.height_px - 1)

    @property
    def matrix(self) -> Array:
        """Return the intrinsic matrix K, (3, 3), from the optical frame to pixels."""
        x_px, y_px = self.centre_px
        focal_px = self.focal_px
        return np.array([[focal_px, 0.0, x_px], [0.0, focal_px, y_px], [0.0, 0.0, 1.0]])

    def rays(self) -> Array:
        """Compute the point at depth 1 on the ray of each pixel, (height, width, 3)."""
        x_px, y_px = self.centre_px
        x = (np.arange(self.width_px) - x_px) / self.focal_px
        y = (np.arange(self.height_px) - y_px) / self.focal_px
        right, down = np.meshgrid(x, y)
        return np.stack([right, down, np.ones_like(right)], axis=-1)


class Deprojection:
    """
    Converts the depth images of a camera to organised point clouds, one point for each pixel.

    Parameters
    ----------
    pinhole
        Image size and field of view of the camera.

    """

    def __init__(self, pinhole: Pinhole) -> None:
        self._rays = pinhole.rays().astype(np.float32)

    def fill(self, cloud: Cloud, depth: Depth) -> None:
        """
        Deproject a depth image into an organised point cloud.

        Parameters
        ----------
        cloud
            Where to write the points (height, width, 3), in m in the optical frame; NaN where
            nothing is seen.
        depth
            Distances along the optical axis (height, width), in m; infinite where nothing is seen.

        """
        seen = np.where(np.isfinite(depth), depth, np.float32(np.nan))
        np.multiply(self._rays, seen[..., None], out=cloud)
