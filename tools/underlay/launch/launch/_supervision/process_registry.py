# SPDX-License-Identifier: Apache-2.0
"""All the processes of a launch that are running."""

from __future__ import annotations

from typing import Optional, TYPE_CHECKING

from launch._supervision.orphan_guard import OrphanGuard
from launch._supervision.program import Child, execute, Program

if TYPE_CHECKING:
    from launch._supervision.prefork.prefork import Prefork
    from launch._supervision.running_process import RunningProcess


class ProcessRegistry:
    """Knows the running processes and leaves none of them behind."""

    def __init__(self) -> None:
        """Create an empty registry."""
        self._processes: set[RunningProcess] = set()
        self._guard = OrphanGuard()
        self._prefork: Optional[Prefork] = None

    async def spawn(self, program: Program, stdout: int, stderr: int) -> Child:
        """Start a program; it is forked if that is faster and makes no difference to it."""
        if program.preloader is None:
            return await execute(program, stdout, stderr)
        if self._prefork is None:
            from launch._supervision.prefork.prefork import Prefork

            self._prefork = Prefork(self._guard)
        return await self._prefork.spawn(program, stdout, stderr)

    def hurry(self) -> None:
        """Wait for no template any more; what is still to be started is executed."""
        if self._prefork is not None:
            self._prefork.close()

    def add(self, process: RunningProcess) -> None:
        """Note a process that was started."""
        self._processes.add(process)
        self._guard.add(process.pid)

    def remove(self, process: RunningProcess) -> None:
        """Forget a process that has ended, with all of its group."""
        self._processes.discard(process)
        self._guard.remove(process.pid)

    def close(self) -> None:
        """Kill what is still running; after an orderly shutdown that is nothing."""
        self.hurry()
        for process in self._processes:
            process.kill_at_once()
            self._guard.remove(process.pid)
        self._processes.clear()
        self._guard.close()
