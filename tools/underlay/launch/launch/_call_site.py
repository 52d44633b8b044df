# SPDX-License-Identifier: Apache-2.0
"""Find the line of the launch file that created an action."""

from __future__ import annotations

import sys
from typing import NamedTuple, Optional

_OWN_PACKAGES = frozenset(('launch', 'launch_ros', 'launch_xml', 'launch_yaml'))
_COMMANDS = frozenset(('ros2cli', 'ros2launch'))


class CallSite(NamedTuple):
    """A line of a file."""

    file_name: str
    line: int

    def __str__(self) -> str:
        """Return the line as people write it."""
        return f"'{self.file_name}', line {self.line}"


def calling_line() -> Optional[CallSite]:
    """Return the innermost line that is not of launch itself, None if a command called."""
    frame = sys._getframe(1)
    while frame is not None:
        package = str(frame.f_globals.get('__name__', '')).partition('.')[0]
        if package in _COMMANDS:
            return None
        if package not in _OWN_PACKAGES:
            return CallSite(frame.f_code.co_filename, frame.f_lineno)
        frame = frame.f_back  # type: ignore[assignment]
    return None


def note_place(error: Exception, site: Optional[CallSite], action_name: str = '') -> None:
    """Note on an exception the line that it comes from, unless a more exact one is known."""
    if site is None or hasattr(error, 'launch_call_site'):
        return
    error.launch_call_site = site  # type: ignore[attr-defined]
    error.launch_action_name = action_name  # type: ignore[attr-defined]
