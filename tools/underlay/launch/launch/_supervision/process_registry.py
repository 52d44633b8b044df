# SPDX-License-Identifier: Apache-2.0
"""All the processes of a launch that are running."""

from __future__ import annotations

import asyncio
from dataclasses import replace
import os
from typing import Optional, TYPE_CHECKING

from launch._supervision.family import detached_environment, Family, unmarked
from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.program import Child, execute, Program
from launch._temporary_files import FileListening

if TYPE_CHECKING:
    from launch._supervision.prefork.prefork import Prefork
    from launch._supervision.remainder import Remainder
    from launch._supervision.running_process import RunningProcess


class ProcessRegistry:
    """
    Knows the running processes and leaves none of them behind, nor what they have started.

    Parameters
    ----------
    loop
        The event loop of the launch.
    forks
        Whether Python programs may be forked from a template rather than executed.

    Attributes
    ----------
    family
        The processes of this run of the launch.

    """

    def __init__(self, loop: asyncio.AbstractEventLoop, *, forks: bool = True) -> None:
        self.family = Family.of_new_run()
        self._processes: set[RunningProcess] = set()
        self._guard = OrphanGuard(self.family, loop)
        self._files = FileListening(self._guard.add_file)
        self._remainder: Optional[Remainder] = None
        self._forks = forks
        self._prefork: Optional[Prefork] = None
        self._sigterm_s = self._sigkill_s = 0.0
        self._has_started = False
        self._is_finished = False

    async def spawn(self, program: Program, stdout: int, stderr: int) -> Child:
        """
        Start a program; it is forked if that is faster and makes no difference to it.

        Parameters
        ----------
        program
            What is started.
        stdout, stderr
            The descriptors that its output goes to.

        Raises
        ------
        OSError
            The program cannot be started.

        """
        environment = os.environ if program.env is None else program.env
        if program.detached:
            environment = detached_environment(environment)
            return await execute(
                replace(program, env=environment, marking=unmarked), stdout, stderr
            )
        self._guard.start()
        self._has_started = True
        program = replace(
            program, env=self.family.environment(environment), marking=self.family.marking
        )
        if program.preloader is None or not self._forks:
            return await execute(program, stdout, stderr)
        if self._prefork is None:
            from launch._supervision.prefork.prefork import Prefork

            self._prefork = Prefork(self._guard)
        return await self._prefork.spawn(program, stdout, stderr)

    def hurry(self) -> None:
        """Wait for no template any more; what is still to be started is executed."""
        if self._prefork is not None:
            self._prefork.close()

    def add(self, process: RunningProcess, sigterm_s: float, sigkill_s: float) -> None:
        """
        Register a process that was started.

        Parameters
        ----------
        process
            The process, which leads its group.
        sigterm_s, sigkill_s
            The seconds from SIGINT to SIGTERM, and from then to SIGKILL; the largest of all
            processes are used for what is left at the end.

        """
        self._sigterm_s = max(self._sigterm_s, sigterm_s)
        self._sigkill_s = max(self._sigkill_s, sigkill_s)
        self._processes.add(process)
        self._guard.add(process.pid)

    def remove(self, process: RunningProcess) -> None:
        """
        Forget a process that has ended, with all of its group.

        Parameters
        ----------
        process
            The process.

        """
        self._processes.discard(process)
        self._guard.remove(process.pid)

    def _groups(self) -> set[int]:
        groups = {process.pid for process in self._processes}
        return groups if self._prefork is None else groups | self._prefork.groups()

    # The end.

    def end_remainder(self) -> None:
        """Begin to end what has left the groups of its processes."""
        if self._has_started:
            self._ending().begin(self._sigterm_s, self._sigkill_s)

    async def finish(self) -> None:
        """Wait until nothing is left, now that all processes have ended."""
        self.hurry()
        if self._has_started and (self._remainder is not None or self.family.members()):
            await self._ending().finish(self._sigterm_s, self._sigkill_s)
        self._is_finished = True

    def _ending(self) -> Remainder:
        if self._remainder is None:
            from launch._supervision.remainder import Remainder

            self._remainder = Remainder(self.family, self._groups)
        return self._remainder

    def close(self) -> None:
        """Kill what is still running; after an orderly shutdown that is nothing."""
        self.hurry()
        for process in self._processes:
            process.kill_at_once()
            self._guard.remove(process.pid)
        self._processes.clear()
        if self._has_started and not self._is_finished:
            from launch._supervision.remainder import kill_at_once

            kill_at_once(self.family)
        self._guard.close()
        self._files.close()
