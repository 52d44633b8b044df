# SPDX-License-Identifier: Apache-2.0
"""The base class of the events of a process's input and output."""

from __future__ import annotations

from typing import Any

from launch.events.process.running_process_event import RunningProcessEvent


class ProcessIO(RunningProcessEvent):
    """
    Event of bytes that a process wrote, or that are written to it.

    Parameters
    ----------
    text
        The bytes as received, not split into lines.
    fd
        The number of the stream: 0, 1 or 2.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessIO'

    def __init__(self, *, text: bytes, fd: int, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__text = text
        self.__fd = fd

    @property
    def text(self) -> bytes:
        """Return the bytes as received, not split into lines."""
        return self.__text

    @property
    def from_stdin(self) -> bool:
        """Whether the bytes are for the standard input."""
        return self.__fd == 0

    @property
    def from_stdout(self) -> bool:
        """Whether the bytes come from the standard output."""
        return self.__fd == 1

    @property
    def from_stderr(self) -> bool:
        """Whether the bytes come from the standard error output."""
        return self.__fd == 2
