# SPDX-License-Identifier: Apache-2.0
"""Cameras of a model to render, and their image sizes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math

from humanoid_simulation.camera.pinhole import Pinhole
from humanoid_simulation.choosing import named
import mujoco


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
