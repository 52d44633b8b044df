# SPDX-License-Identifier: Apache-2.0
"""Which camera of a model is rendered, in which size, and its pinhole model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_simulation.camera.images import Cloud, Depth
from humanoid_simulation.errors import named, SimulationError
import mujoco
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
                f'An image of {self.width_px} x {self.height_px} pixels is empty. Give the camera '
                'at least one pixel in each direction.'
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


@dataclass(frozen=True)
class CameraView:
    """A camera of the model, by its name, and the size of its images."""

    camera: str
    width_px: int
    height_px: int


@dataclass(frozen=True)
class Wanted:
    """Which images of a camera are requested."""

    color: bool
    depth: bool
    cloud: bool = False
    """The point cloud, which is computed from the depth."""

    def __bool__(self) -> bool:
        """Check whether any image is requested."""
        return self.color or self.depth or self.cloud


def camera_id(model: mujoco.MjModel, name: str) -> int:
    """
    Look up the id of a camera in the model.

    Parameters
    ----------
    model
        The world.
    name
        The name of the camera.

    Raises
    ------
    SimulationError
        The model has no such camera.

    """
    numbers = {model.camera(number).name: number for number in range(model.ncam)}
    return named('camera', name, numbers)


def pinhole_of(model: mujoco.MjModel, view: CameraView) -> Pinhole:
    """
    Derive the pinhole camera of a view from the model.

    Parameters
    ----------
    model
        The world.
    view
        The name of the camera, and the image size.

    Raises
    ------
    SimulationError
        The model has no such camera, or its image is empty or its field of view is not in (0, pi).

    """
    fovy_deg = float(model.cam_fovy[camera_id(model, view.camera)])
    return Pinhole(view.width_px, view.height_px, math.radians(fovy_deg))


def check_views(model: mujoco.MjModel, views: Sequence[CameraView]) -> None:
    """
    Check that all views can be rendered.

    Parameters
    ----------
    model
        The world.
    views
        The cameras, and the sizes of their images.

    Raises
    ------
    SimulationError
        A view cannot be rendered, see `pinhole_of`.

    """
    for view in views:
        pinhole_of(model, view)
