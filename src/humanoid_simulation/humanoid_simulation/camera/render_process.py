# SPDX-License-Identifier: Apache-2.0
"""The simulator's side of a render process."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
import os
import signal
import subprocess
import sys
from typing import IO

from humanoid_simulation.camera.methods import environment_of
from humanoid_simulation.camera.pinhole import Wanted
from humanoid_simulation.camera.protocol import (
    Assignment,
    FAILED,
    READY,
    request_line,
    unnamed_file,
)

_MODULE = 'humanoid_simulation.camera.render_main'
_LAST_WORDS = 300


class RenderProcess:
    """
    A process that renders one request at a time; only `wait` blocks.

    Its standard error, such as warnings of drivers, goes to a file in memory. It ends at the
    latest with the thread that has started it.

    Parameters
    ----------
    assignment
        What the process renders, by which method, and the files that it shares.

    Raises
    ------
    OSError
        The process cannot be started, as when memory is short.

    """

    def __init__(self, assignment: Assignment) -> None:
        self._noise = unnamed_file('noise')
        try:
            self._process = _start(assignment, self._noise)
        except OSError:
            os.close(self._noise)
            raise
        self._requests, self._replies = _pipes_of(self._process)
        os.set_blocking(self._replies.fileno(), False)
        self._unread = b''
        self._reason = ''
        self.is_ready = False
        """Whether it has started up and can render."""
        self.is_busy = True
        """Whether a reply is pending: that it is ready, or that images are done."""

    @property
    def pid(self) -> int:
        """Its process id."""
        return self._process.pid

    def request(self, wanted: Sequence[Wanted]) -> None:
        """
        Request images; call only if the process is ready and not busy.

        Parameters
        ----------
        wanted
            Which images, one element for each view.

        """
        self.is_busy = True
        with suppress(BrokenPipeError):  # `end_reason` reports that it has ended
            self._requests.write(request_line(wanted).encode())

    def poll(self) -> None:
        """Read and handle the replies that have arrived."""
        with suppress(BlockingIOError):
            self._unread += os.read(self._replies.fileno(), 4096)
        *lines, self._unread = self._unread.split(b'\n')
        for line in lines:
            self._take(line.decode(errors='replace'))

    def has_ended(self) -> bool:
        """Check whether the process has ended."""
        return self._process.poll() is not None

    def end_reason(self) -> str:
        """Return the reason why it has ended, as the end of a sentence."""
        status = self._process.poll()
        if self._reason:
            return self._reason
        if status is not None and status < 0:
            return f'its process was ended by {_signal_name(-status)}.{self._last_words()}'
        return f'its process ended with status {status}.{self._last_words()}'

    def kill(self, reason: str) -> None:
        """
        Kill the process; `has_ended` reports when it is gone.

        Parameters
        ----------
        reason
            What `end_reason` returns from now on, unless the process gave one itself.

        """
        self._reason = self._reason or reason
        self._process.kill()

    def release(self) -> None:
        """Close the pipes to the process, which ends it; it cannot be used afterwards."""
        with suppress(BrokenPipeError):
            self._requests.close()
        self._replies.close()
        os.close(self._noise)

    def wait(self, timeout_s: float) -> None:
        """
        Block until the process has ended; kill it after a timeout.

        Parameters
        ----------
        timeout_s
            How long it has to end by itself, in s of real time.

        """
        try:
            self._process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _take(self, line: str) -> None:
        """Handle one line of reply."""
        self.is_busy = False
        if line == READY:
            self.is_ready = True
        elif line.startswith(FAILED):
            self.is_busy = True
            self._reason = line.removeprefix(FAILED).rstrip('.') + '.'

    def _last_words(self) -> str:
        """Return the last line of its standard error, to be appended to a message."""
        size = os.fstat(self._noise).st_size
        text = os.pread(self._noise, _LAST_WORDS, max(0, size - _LAST_WORDS))
        lines = text.decode(errors='replace').strip().splitlines()
        return f' Last output: {lines[-1].strip()}' if lines else ''


def _start(assignment: Assignment, noise: int) -> subprocess.Popen[bytes]:
    """Start a process, with its standard error redirected to an open file."""
    return subprocess.Popen(
        [sys.executable, '-m', _MODULE, assignment.as_text()],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=noise,
        bufsize=0,
        pass_fds=(assignment.model_file, assignment.frames_file),
        env=environment_of(assignment.method, os.environ),
    )


def _pipes_of(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes]]:
    """Return the pipes of its standard input and output."""
    if process.stdin is None or process.stdout is None:
        raise RuntimeError('A process was started without pipes.')
    return process.stdin, process.stdout


def _signal_name(number: int) -> str:
    """Return the name of a signal, such as SIGSEGV."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f'signal {number}'
