# SPDX-License-Identifier: Apache-2.0
"""All the processes of a launch that are running."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._supervision.orphan_guard import OrphanGuard

if TYPE_CHECKING:
    from launch._supervision.running_process import RunningProcess


class ProcessRegistry:
    """Knows the running processes and leaves none of them behind."""

    def __init__(self) -> None:
        """Create an empty registry."""
        self._processes: set[RunningProcess] = set()
        self._guard = OrphanGuard()

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
        for process in self._processes:
            process.kill_at_once()
            self._guard.remove(process.pid)
        self._processes.clear()
        self._guard.close()
