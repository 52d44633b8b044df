# SPDX-License-Identifier: Apache-2.0
"""Programs, how to execute them, and the options of their processes."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
import subprocess
from typing import Any, IO, Optional, Protocol


@dataclass(frozen=True)
class Program:
    """Command with the working directory, environment and options of its process."""

    command: Sequence[str]
    cwd: Optional[str]
    env: Optional[Mapping[str, str]]
    shell: bool
    preloader: Optional[str] = None  # the module that imports what such a process needs
    detached: bool = False  # whether it outlives the launch
    marking: Callable[[], AbstractContextManager[None]] = nullcontext  # entered at its start


@dataclass(frozen=True)
class PerformedOptions:
    """Options of a process with performed substitutions; the timeouts remain strings."""

    shell: bool
    emulate_tty: bool
    cached_output: bool
    log_cmd: bool
    output: Any
    output_format: str
    sigterm_timeout: str
    sigkill_timeout: str
    respawn: bool
    detached: bool
    respawn_delay: Optional[float]
    respawn_max_retries: int

    @property
    def timeouts_s(self) -> tuple[float, float]:
        """Return the time from SIGINT to SIGTERM, and from SIGTERM to SIGKILL."""
        return float(self.sigterm_timeout), float(self.sigkill_timeout)

    def may_respawn(self, respawned: int) -> bool:
        """
        Whether to respawn the process after it has exited.

        Parameters
        ----------
        respawned
            How many times it has already been respawned.

        """
        return self.respawn and (
            self.respawn_max_retries < 0 or respawned < self.respawn_max_retries
        )


class ProgramOwner(Protocol):
    """Action that runs a program, as the supervisor of its process knows it."""

    @property
    def preloader(self) -> Optional[str]:
        """Return the module that imports what the program needs; without it, none is forked."""

    def description_of_process(self) -> dict[str, Any]:
        """Return the final name, cmd, cwd and env."""


class Child(Protocol):
    """A child process that leads a session of its own."""

    @property
    def pid(self) -> int:
        """Return the id of the process."""

    @property
    def stdin(self) -> Optional[IO[bytes]]:
        """Return the write end of the standard input pipe."""

    def wait(self) -> int:
        """Wait for the process to exit; return the exit status, negative for a signal."""


Spawn = Callable[[Program, int, int], Awaitable[Child]]


async def execute(program: Program, stdout: int, stderr: int) -> subprocess.Popen[bytes]:
    """
    Start a program in a session of its own.

    Parameters
    ----------
    program
        The program to start.
    stdout, stderr
        The file descriptors for its output.

    Returns
    -------
    Popen
        The process, whose standard input is a pipe unless it is detached.

    Raises
    ------
    OSError
        The program cannot be started.

    """
    with program.marking():
        return subprocess.Popen(
            ' '.join(program.command) if program.shell else list(program.command),
            shell=program.shell,
            cwd=program.cwd,
            env=program.env,
            stdin=subprocess.DEVNULL if program.detached else subprocess.PIPE,
            stdout=stdout,
            stderr=stderr,
            bufsize=0,
            start_new_session=True,
        )
