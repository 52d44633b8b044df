# SPDX-License-Identifier: Apache-2.0
"""The event of a process that has exited."""

from __future__ import annotations

from typing import Any

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessExited(RunningProcessEvent):
    """
    Event of a process that has exited.

    Parameters
    ----------
    returncode
        The exit status, or the negative number of the signal that terminated the process.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessExited'

    def __init__(self, *, returncode: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__returncode = returncode

    @property
    def returncode(self) -> int:
        """Return the exit status, or the negative number of the signal."""
        return self.__returncode
