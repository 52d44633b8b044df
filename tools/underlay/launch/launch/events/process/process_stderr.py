# SPDX-License-Identifier: Apache-2.0
"""The event of bytes from the standard error output of a process."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStderr(ProcessIO):
    """
    Event of bytes that a process wrote to its standard error output.

    Parameters
    ----------
    text
        The bytes as received, not split into lines.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessStderr'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=2, **kwargs)
