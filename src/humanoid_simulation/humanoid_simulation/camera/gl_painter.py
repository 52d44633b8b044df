# SPDX-License-Identifier: Apache-2.0
"""Off-screen rendering with OpenGL."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from humanoid_simulation.camera.images import Color, Depth, FAR_M, NEAR_M
from humanoid_simulation.errors import SimulationError
import mujoco
import numpy as np

_SPARE_GEOMS = 500
_LEFT_OUT = (
    mujoco.mjtRndFlag.mjRND_SHADOW,
    mujoco.mjtRndFlag.mjRND_REFLECTION,
    mujoco.mjtRndFlag.mjRND_HAZE,
)


class GlPainter:
    """
    Off-screen renderer with OpenGL; a process can use one method only.

    Shadows and anti-aliasing are off: without a graphics card, they cost seven times as much. The
    model must not be shared: its visual settings are changed.

    Parameters
    ----------
    method
        How OpenGL runs without a window: EGL or OSMESA.
    model
        The world.
    width_px, height_px
        Size of the largest image that will be rendered.

    Raises
    ------
    SimulationError
        OpenGL is not installed, cannot be used, or cannot draw without a window.

    """

    def __init__(self, method: str, model: mujoco.MjModel, width_px: int, height_px: int) -> None:
        self._model = model
        _make_cheap(model, width_px, height_px)
        self._scene = mujoco.MjvScene(model, maxgeom=model.ngeom + _SPARE_GEOMS)
        for flag in _LEFT_OUT:
            self._scene.flags[flag] = 0
        self._has_sky = mujoco.mjtTexture.mjTEXTURE_SKYBOX in list(model.tex_type)
        self._option = mujoco.MjvOption()
        self._camera = mujoco.MjvCamera()
        self._camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        self._gl = _start(method, width_px, height_px)
        self._context = _offscreen_context(model)

    def draw(
        self, data: mujoco.MjData, camera: int, color: Color | None, depth: Depth | None
    ) -> None:
        """
        Render the images of a camera by OpenGL.

        Parameters
        ----------
        data, camera, color, depth
            As for `Painter.draw`.

        """
        self._camera.fixedcamid = camera
        everything = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(
            self._model, data, self._option, None, self._camera, everything, self._scene
        )
        if self._has_sky:
            self._render(color, None)
            self._render(None, depth)
        else:
            self._render(color, depth)

    def close(self) -> None:
        """Free the OpenGL context."""
        self._context.free()
        self._gl.free()

    def _render(self, color: Color | None, depth: Depth | None) -> None:
        """Render into the given images; the skybox is drawn only without depth."""
        shape = _shape_of(color, depth)
        if shape is None:
            return
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SKYBOX] = depth is None
        window = mujoco.MjrRect(0, 0, shape[1], shape[0])
        mujoco.mjr_render(window, self._scene, self._context)
        mujoco.mjr_readPixels(color, depth, window, self._context)
        if color is not None:
            color[:] = color[::-1].copy()
        if depth is not None:
            depth[:] = _metres(depth[::-1])


def _start(method: str, width_px: int, height_px: int) -> Any:
    """Create the OpenGL context of a method."""
    try:
        library = import_module(f'mujoco.{method}')
    except (ImportError, AttributeError) as error:  # PyOpenGL uses libraries it has not found
        raise SimulationError(f'its library was not found ({error}).') from error
    try:
        context = library.GLContext(width_px, height_px)
        context.make_current()
    except Exception as error:  # the type depends on the driver
        raise SimulationError(f'its library cannot be used ({error}).') from error
    return context


def _make_cheap(model: mujoco.MjModel, width_px: int, height_px: int) -> None:
    """Set the visual options of a model: quality, image size, near and far plane."""
    visual = model.vis
    visual.quality.shadowsize = 0
    visual.quality.offsamples = 0
    visual.global_.offwidth = width_px
    visual.global_.offheight = height_px
    visual.map.znear = NEAR_M / model.stat.extent
    visual.map.zfar = FAR_M / model.stat.extent


def _offscreen_context(model: mujoco.MjModel) -> mujoco.MjrContext:
    """Create the rendering context with the off-screen buffer."""
    context = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_50)
    mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, context)
    if context.currentBuffer != mujoco.mjtFramebuffer.mjFB_OFFSCREEN:
        raise SimulationError('it cannot render without a window.')
    context.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR
    return context


def _shape_of(color: Color | None, depth: Depth | None) -> tuple[int, ...] | None:
    """Return height and width of the images, or None without any."""
    if color is not None:
        return color.shape[:2]
    return None if depth is None else depth.shape


def _metres(buffer: Depth) -> Depth:
    """Convert a depth buffer, 1 at NEAR_M and 0 at FAR_M, to depth along the optical axis."""
    near_over = buffer.astype(np.float64) * (FAR_M - NEAR_M) + NEAR_M
    metres = NEAR_M * FAR_M / near_over
    metres[buffer <= 0.0] = np.inf
    return metres.astype(np.float32)
