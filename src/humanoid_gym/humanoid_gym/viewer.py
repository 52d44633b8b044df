# SPDX-License-Identifier: Apache-2.0
"""Pictures of the robot from outside, for `render`."""

from __future__ import annotations

import copy
import logging
import time

from humanoid_control.backends import Array
from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.camera import CameraView, Renderer, Wanted
from humanoid_simulation.camera.images import Color
from humanoid_simulation.camera.methods import AUTO, methods_of
from humanoid_simulation.camera.pinhole import camera_id
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.description import in_world
import mujoco
import numpy as np

FROM_BASE_M = (2.1, -1.8, 0.7)
"""Where the camera is, from the base of the robot, along the axes of the world."""
FOVY_DEG = 42.0
_PATIENCE_S = 100.0
_COLOR = (Wanted(color=True, depth=False),)


class Viewer:
    """
    A camera that follows the robot; another process renders, by OpenGL or by ray casting.

    Parameters
    ----------
    backend
        The world with the robot.
    width_px, height_px
        The size of the pictures.

    Raises
    ------
    SimulationError
        The size is not possible.

    """

    def __init__(self, backend: MujocoBackend, width_px: int, height_px: int) -> None:
        camera = backend.camera()
        model = copy.copy(backend.model)
        _follow_robot(model, camera_id(model, camera))
        view = CameraView(camera, width_px, height_px)
        log = logging.getLogger('humanoid_gym')
        self._renderer = Renderer(model, [view], methods_of(AUTO), log)
        self._renderer.need()

    def picture(self, qpos: Array) -> Color:
        """
        Render a state, and wait for the picture.

        Parameters
        ----------
        qpos
            The generalised positions (nq,) of the state.

        Raises
        ------
        SimulationError
            There is no picture in time.

        """
        end_s = time.monotonic() + _PATIENCE_S
        while (now_s := time.monotonic()) < end_s:
            pictures = self._renderer.poll(now_s)
            if pictures is not None:
                return np.array(pictures.colors[0])
            if self._renderer.can_draw:  # not while it draws
                self._renderer.request(qpos, 0, _COLOR, now_s)
            time.sleep(0.001)
        raise SimulationError(
            f'There was no picture within {_PATIENCE_S:.0f} s. The log of humanoid_gym says why '
            'the renderer failed; without a render_mode, nothing is rendered.'
        )

    def close(self) -> None:
        """End the process that renders."""
        self._renderer.close()


def _follow_robot(model: mujoco.MjModel, camera: int) -> None:
    """Let a camera follow the base of the robot from outside, in a fixed direction."""
    back = np.array(FROM_BASE_M) / np.linalg.norm(FROM_BASE_M)
    right = np.cross((0.0, 0.0, 1.0), back)
    right /= np.linalg.norm(right)
    axes = np.column_stack((right, np.cross(back, right), back))
    model.cam_mode[camera] = mujoco.mjtCamLight.mjCAMLIGHT_TRACK.value
    model.cam_bodyid[camera] = model.body(in_world('', 'base_link')).id
    model.cam_pos0[camera] = FROM_BASE_M
    model.cam_mat0[camera] = axes.ravel()
    model.cam_fovy[camera] = FOVY_DEG
