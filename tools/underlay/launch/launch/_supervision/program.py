# SPDX-License-Identifier: Apache-2.0
"""Programs, and how to execute them."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
import subprocess
from typing import IO, Optional, Protocol


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
