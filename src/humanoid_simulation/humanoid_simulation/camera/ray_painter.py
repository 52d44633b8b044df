# SPDX-License-Identifier: Apache-2.0
"""Rendering by ray casting, one ray per pixel, without OpenGL."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_simulation.camera.flat_colors import brightness, geom_colors, sky_color
from humanoid_simulation.camera.painter import Color, Depth, FAR_M
from humanoid_simulation.camera.ray_cast import cast_rays, Hits, see_all
from humanoid_simulation.camera.view import camera_id, CameraView, pinhole_of
import mujoco
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class RayPainter:
    """
    Renderer by ray casting: matt surfaces in flat colours, and exact depth.

    The model must not be shared: its bounding volumes are disabled, and some of its geoms are
    hidden during rendering.

    Parameters
    ----------
    model
        The world.
    views
        The cameras that `draw` can render, and the sizes of their images.

    Raises
    ------
    SimulationError
        A view cannot be rendered, see `pinhole_of`.

    """

    def __init__(self, model: mujoco.MjModel, views: Sequence[CameraView]) -> None:
        see_all(model)
        self._model = model
        self._rays = {camera_id(model, view.camera): _unit_rays(model, view) for view in views}
        self._colors = geom_colors(model)
        self._sky = sky_color(model)

    def draw(
        self, data: mujoco.MjData, camera: int, color: Color | None, depth: Depth | None
    ) -> None:
        """
        Render the images of a camera by ray casting.

        Parameters
        ----------
        data, camera, color, depth
            As for `Painter.draw`; the camera is one of the views.

        """
        rays = self._rays[camera]
        turn = data.cam_xmat[camera].reshape(3, 3)
        hits = cast_rays(self._model, data, data.cam_xpos[camera], rays @ turn.T)
        along_m = hits.distances_m * -rays[:, 2]
        is_seen = along_m < FAR_M
        if depth is not None:
            depth[:] = np.where(is_seen, along_m, np.inf).reshape(depth.shape)
        if color is not None:
            lit = self._lit(data, hits, forward=-turn[:, 2])
            shown = np.where(is_seen[:, None], lit, self._sky)
            color[:] = (255.0 * np.clip(shown, 0.0, 1.0)).reshape(color.shape)

    def close(self) -> None:
        """Release nothing: there are no resources besides memory."""

    def _lit(self, data: mujoco.MjData, hits: Hits, forward: Array) -> Array:
        """Compute the lit colour at each hit, (n, 3), in which 1 is full brightness."""
        light = brightness(self._model, data, hits.points, hits.normals, forward)
        return self._colors[hits.geoms] * light


def _unit_rays(model: mujoco.MjModel, view: CameraView) -> Array:
    """Compute the unit rays of all pixels, (n, 3), in MuJoCo's camera frame: -z forward, y up."""
    rays = pinhole_of(model, view).rays().reshape(-1, 3) * (1.0, -1.0, -1.0)
    return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))
