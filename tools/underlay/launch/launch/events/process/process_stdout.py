# SPDX-License-Identifier: Apache-2.0
"""The event of bytes from the standard output of a process."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStdout(ProcessIO):
    """
    Event of bytes that a process wrote to its standard output.

    Parameters
    ----------
    text
        The bytes as received, not split into lines.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessStdout'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=1, **kwargs)
