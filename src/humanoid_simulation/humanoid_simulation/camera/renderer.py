# SPDX-License-Identifier: Apache-2.0
"""Rendering of copied states in a process that may fail."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import os

from humanoid_simulation.camera.frames import Frames, unnamed_file
from humanoid_simulation.camera.painter import Cloud, Color, Depth
from humanoid_simulation.camera.picture_noise import PictureNoise
from humanoid_simulation.camera.process_keeper import Log, Patience, ProcessKeeper
from humanoid_simulation.camera.protocol import Assignment
from humanoid_simulation.camera.render_process import RenderProcess
from humanoid_simulation.camera.view import CameraView, check_views, Wanted
import mujoco
import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Pictures:
    """Images of all views at one time; valid until the next request."""

    time_ns: int
    wanted: tuple[Wanted, ...]
    colors: Sequence[Color]
    depths: Sequence[Depth]
    clouds: Sequence[Cloud]


class Renderer:
    """
    Renders one state at a time in another process, which starts once `need` was called.

    Only `close` waits for that process; if it ends or hangs, it is replaced.

    Parameters
    ----------
    model
        The world, which is copied: later changes to it have no effect.
    views
        The cameras to render, and the sizes of their images.
    methods : Sequence[str]
        The rendering methods to try, best first.
    log
        Where to report which method renders, and failures.
    patience
        Timeouts of the process.
    noise
        Standard deviations of pixels.

    Raises
    ------
    SimulationError
        A view cannot be rendered, see `pinhole_of`.

    """

    def __init__(
        self,
        model: mujoco.MjModel,
        views: Sequence[CameraView],
        methods: Sequence[str],
        log: Log,
        patience: Patience = Patience(),
        noise: PictureNoise = PictureNoise(),
    ) -> None:
        check_views(model, views)
        self._views, self._noise = tuple(views), noise
        self._model_file = _file_with(model)
        self._frames_file = unnamed_file('frames')
        self._frames = Frames(self._frames_file, model.nq, views)
        self._keeper = ProcessKeeper(self._start, methods, log, patience)
        self._is_needed = False
        self._requested: tuple[int, tuple[Wanted, ...]] | None = None

    @property
    def process_id(self) -> int | None:
        """Return the process id of the render process, if it runs."""
        process = self._keeper.process
        return process.pid if process else None

    def need(self) -> None:
        """Announce that images will be requested: the process starts at the next poll."""
        self._is_needed = True

    @property
    def can_draw(self) -> bool:
        """Whether a request can be made."""
        return self._keeper.can_draw and self._requested is None

    def request(
        self, qpos: NDArray[np.float64], time_ns: int, wanted: Sequence[Wanted], now_s: float
    ) -> None:
        """
        Request images of a state, which is copied; call only if `can_draw`.

        Parameters
        ----------
        qpos
            The generalised positions of the state (nq,).
        time_ns
            The simulated time of the state, in ns.
        wanted
            Which images, one element for each view.
        now_s
            Time of a monotonic clock, in s.

        """
        self._frames.qpos[:] = qpos
        self._requested = (time_ns, tuple(wanted))
        self._keeper.request(wanted, now_s)

    def poll(self, now_s: float) -> Pictures | None:
        """
        Supervise the render process, and fetch the requested images once they are done.

        Parameters
        ----------
        now_s
            Time of a monotonic clock, in s.

        Returns
        -------
        Pictures or None
            The images, once for each request; None until then, and if the process was lost
            meanwhile.

        """
        if not self._is_needed:
            return None
        process = self._keeper.process
        self._keeper.tend(now_s)
        if self._requested is None:
            return None
        if self._keeper.process is not process:
            self._requested = None
        elif self._keeper.can_draw:
            return self._finished(*self._requested)
        return None

    def close(self) -> None:
        """End the process; the renderer cannot be used afterwards."""
        self._keeper.close()
        os.close(self._model_file)
        os.close(self._frames_file)

    def _start(self, method: str) -> RenderProcess:
        """Start a process that renders by a method."""
        files = self._model_file, self._frames_file
        return RenderProcess(Assignment(method, *files, self._views, self._noise))

    def _finished(self, time_ns: int, wanted: tuple[Wanted, ...]) -> Pictures:
        """Return the images that are in the shared memory now."""
        self._requested = None
        self._keeper.note_picture()
        frames = self._frames
        return Pictures(time_ns, wanted, frames.colors, frames.depths, frames.clouds)


def _file_with(model: mujoco.MjModel) -> int:
    """Write a model to a file in memory, and return its descriptor."""
    content = np.empty(mujoco.mj_sizeModel(model), dtype=np.uint8)
    mujoco.mj_saveModel(model, None, content)
    file = unnamed_file('model')
    with open(file, 'wb', closefd=False) as stream:
        stream.write(content.tobytes())
    return file
