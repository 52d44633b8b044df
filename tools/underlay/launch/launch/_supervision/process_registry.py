# SPDX-License-Identifier: Apache-2.0
"""Registry of the running processes of a launch."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import replace
import os
from typing import Optional, TYPE_CHECKING

from launch._supervision.family import detached_environment, Family, unmarked
from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.program import Child, execute, Program
from ros_environment.temporary_files import FileListening

if TYPE_CHECKING:
    from launch._supervision.member import Member
    from launch._supervision.prefork.prefork import Prefork
    from launch._supervision.remainder import Remainder
    from launch.launch_run import GroupLeader


class ProcessRegistry:
    """
    Registry of running processes that terminates all of them and their descendants.

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
        self._processes: set[GroupLeader] = set()
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
        Start a program; fork it from a template if that is faster and equivalent.

        Parameters
        ----------
        program
            The program to start.
        stdout, stderr
            The file descriptors for its output.

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
        """Stop using the template; programs that are still to be started are executed."""
        if self._prefork is not None:
            self._prefork.close()

    def add(self, process: GroupLeader, sigterm_s: float, sigkill_s: float) -> None:
        """
        Register a process that was started.

        Parameters
        ----------
        process
            The process, which leads its group.
        sigterm_s, sigkill_s
            The time from SIGINT to SIGTERM and from SIGTERM to SIGKILL, in s; the maximum over all
            processes applies to the processes that are left at the end.

        """
        self._sigterm_s = max(self._sigterm_s, sigterm_s)
        self._sigkill_s = max(self._sigkill_s, sigkill_s)
        self._processes.add(process)
        self._guard.add(process.pid)

    def remove(self, process: GroupLeader) -> None:
        """
        Unregister a process that has exited with all of its group.

        Parameters
        ----------
        process
            The process.

        """
        self._processes.discard(process)
        self._guard.remove(process.pid)

    def detaches(self, environment: Mapping[str, str]) -> bool:
        """
        Whether a process with this environment may outlive the launch.

        Parameters
        ----------
        environment
            Its variables.

        """
        return self.family.detaches(environment)

    def descendants(self, pid: int) -> list[Member]:
        """
        List the processes that a process has started, directly or indirectly.

        Parameters
        ----------
        pid
            The id of the process.

        """
        return self.family.descendants(pid)

    def _groups(self) -> set[int]:
        groups = {process.pid for process in self._processes}
        return groups if self._prefork is None else groups | self._prefork.groups()

    # The end.

    def end_remainder(self) -> None:
        """Start to terminate processes that have left their process groups."""
        if self._has_started:
            self._ending().begin(self._sigterm_s, self._sigkill_s)

    async def finish(self) -> None:
        """Wait until no process is left, after all registered processes have exited."""
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
        """Kill processes that are still running; after an orderly shutdown there are none."""
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
