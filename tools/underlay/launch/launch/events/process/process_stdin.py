# SPDX-License-Identifier: Apache-2.0
"""The event of bytes for the standard input of a process."""

from __future__ import annotations

from typing import Any

from launch.events.process.process_io import ProcessIO


class ProcessStdin(ProcessIO):
    """A process is to read some bytes."""

    name = 'launch.events.process.ProcessStdin'

    def __init__(self, *, text: bytes, **kwargs: Any) -> None:
        """Create the event from the bytes."""
        super().__init__(text=text, fd=0, **kwargs)
