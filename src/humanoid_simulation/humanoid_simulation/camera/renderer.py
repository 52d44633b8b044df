# SPDX-License-Identifier: Apache-2.0
"""Rendering of copied states in a process, which is supervised and replaced when it fails."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import os

from humanoid_control.hosting.reports import Log
from humanoid_simulation.camera.images import Cloud, Color, Depth, PictureNoise
from humanoid_simulation.camera.methods import give_up_sentence, Ladder, RAYS, success_sentence
from humanoid_simulation.camera.pinhole import CameraView, check_views, Wanted
from humanoid_simulation.camera.protocol import Assignment, Frames, unnamed_file
from humanoid_simulation.camera.render_process import RenderProcess
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


@dataclass(frozen=True)
class RenderTimeouts:
    """Timeouts after which the process counts as hung, and the delay before a restart."""

    start_s: float = 60.0
    draw_s: float = 10.0
    retry_s: float = 1.0
    end_s: float = 1.0


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
        patience: RenderTimeouts = RenderTimeouts(),
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


class ProcessKeeper:
    """
    Supervises a render process: starts it, replaces it when it ends or hangs, and logs that.

    No process starts before `tend`. Times are those of a monotonic clock.

    Parameters
    ----------
    start
        Starts a process that renders by the method given; it may raise OSError.
    methods : Sequence[str]
        The rendering methods to try, best first.
    log
        Where to report which method renders, and failures.
    patience
        Timeouts of the process.

    """

    def __init__(
        self,
        start: Callable[[str], RenderProcess],
        methods: Sequence[str],
        log: Log,
        patience: RenderTimeouts,
    ) -> None:
        self._start = start
        self._ladder = Ladder(methods)
        self._log = log
        self._patience = patience
        self._process: RenderProcess | None = None
        self._deadline_s = 0.0
        self._next_start_s = 0.0
        self._said = ''

    @property
    def process(self) -> RenderProcess | None:
        """Return the render process, if there is one."""
        return self._process

    @property
    def can_draw(self) -> bool:
        """Whether the process is ready for a request."""
        process = self._process
        return process is not None and process.is_ready and not process.is_busy

    def tend(self, now_s: float) -> None:
        """
        Supervise the render process: start it, read its replies, replace it if it ends or hangs.

        Call it regularly; it never blocks.

        Parameters
        ----------
        now_s
            Time of a monotonic clock, in s.

        """
        if self._process is None:
            if self._ladder.method and now_s >= self._next_start_s:
                self._begin(now_s)
            return
        self._process.poll()
        if self._process.has_ended():
            self._bury(self._process, now_s)
        elif self._process.is_busy and now_s > self._deadline_s:
            self._process.kill('it did not answer in time.')
        elif self._process.is_ready:
            self._say_once(success_sentence(self._ladder.method, self._ladder.failures))

    def request(self, wanted: Sequence[Wanted], now_s: float) -> None:
        """
        Request images from the render process; call only if `can_draw`.

        Parameters
        ----------
        wanted
            Which images, one element for each view.
        now_s
            Time of the clock of `tend`, in s: `RenderTimeouts.draw_s` later the process counts as
            hung.

        """
        if self._process is not None:
            self._deadline_s = now_s + self._patience.draw_s
            self._process.request(wanted)

    def note_picture(self) -> None:
        """Record that the requested images have arrived."""
        self._ladder.note_picture()

    def close(self) -> None:
        """End the render process."""
        if self._process is not None:
            self._process.release()
            self._process.wait(self._patience.end_s)
            self._process = None

    def _begin(self, now_s: float) -> None:
        """Start a render process."""
        self._deadline_s = now_s + self._patience.start_s
        try:
            self._process = self._start(self._ladder.method)
        except OSError as error:
            self._go_on(f'its process cannot be started: {error.strerror}.', now_s)

    def _bury(self, process: RenderProcess, now_s: float) -> None:
        """Release a process that has ended, and handle its failure."""
        reason = process.end_reason()
        process.release()
        self._process = None
        self._go_on(reason, now_s)

    def _go_on(self, reason: str, now_s: float) -> None:
        """Log why there is no process, and schedule a restart or fall back to the next method."""
        if self._ladder.note_end(reason):
            self._next_start_s = now_s + self._patience.retry_s
            self._log.warning(
                f'The cameras are interrupted: {reason} The simulation continues, and the render '
                'process is restarted.'
            )
        elif not self._ladder.method:
            self._log.warning(give_up_sentence(self._ladder.failures))

    def _say_once(self, sentence: str) -> None:
        """Log the rendering method, unless that was logged already."""
        if sentence == self._said:
            return
        self._said = sentence
        if self._ladder.failures and self._ladder.method == RAYS:
            self._log.warning(sentence)
        else:
            self._log.info(sentence)


def _file_with(model: mujoco.MjModel) -> int:
    """Write a model to a file in memory, and return its descriptor."""
    content = np.empty(mujoco.mj_sizeModel(model), dtype=np.uint8)
    mujoco.mj_saveModel(model, None, content)
    file = unnamed_file('model')
    with open(file, 'wb', closefd=False) as stream:
        stream.write(content.tobytes())
    return file
