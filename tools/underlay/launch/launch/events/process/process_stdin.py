# SPDX-License-Identifier: Apache-2.0
"""The event of bytes for the standard input of a process."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStdin(ProcessIO):
    """
    Event of bytes for the standard input of a process.

    Parameters
    ----------
    text
        The bytes that are written to it.
    **kwargs
        The details of the process, as for `RunningProcessEvent`.

    """

    name = 'launch.events.process.ProcessStdin'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        super().__init__(text=text, fd=0, **kwargs)
