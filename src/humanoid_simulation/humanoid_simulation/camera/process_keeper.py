# SPDX-License-Identifier: Apache-2.0
"""Supervisor of the render process."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from humanoid_simulation.camera.ladder import Ladder
from humanoid_simulation.camera.methods import give_up_sentence, RAYS, success_sentence
from humanoid_simulation.camera.render_process import RenderProcess
from humanoid_simulation.camera.view import Wanted


class Log(Protocol):
    """A logger, such as that of a node."""

    def info(self, message: str) -> object:
        """
        Log an informational message.

        Parameters
        ----------
        message
            One or more sentences.

        """

    def warning(self, message: str) -> object:
        """
        Log a warning.

        Parameters
        ----------
        message
            One or more sentences.

        """


@dataclass(frozen=True)
class Patience:
    """Timeouts after which the process counts as hung, and the delay before a restart."""

    start_s: float = 60.0
    draw_s: float = 10.0
    retry_s: float = 1.0
    end_s: float = 1.0


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
        patience: Patience,
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
            Time of the clock of `tend`, in s: the process counts as hung `Patience.draw_s` later.

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
                f'The cameras are interrupted: {reason} The simulation goes on, and the process '
                'that draws is started again.'
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
