# SPDX-License-Identifier: Apache-2.0
"""The event of bytes from the standard output of a process."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStdout(ProcessIO):
    """A process wrote to its standard output."""

    name = 'launch.events.process.ProcessStdout'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        """Create the event from the bytes."""
        super().__init__(text=text, fd=1, **kwargs)
