# SPDX-License-Identifier: Apache-2.0
"""Functions that tell whether an event belongs to a process."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


def matches_pid(pid: int) -> Callable[[ExecuteLocal], bool]:
    """Return a matcher of the process with this id."""
    return lambda action: bool((action.process_details or {}).get('pid') == pid)


def matches_name(name: str) -> Callable[[ExecuteLocal], bool]:
    """Return a matcher of the processes with this label."""
    return lambda action: bool(action.name == name)


def matches_executable(executable: str) -> Callable[[ExecuteLocal], bool]:
    """Return a matcher of the processes whose program has this name."""

    def matches(action: ExecuteLocal) -> bool:
        command = (action.process_details or {}).get('cmd') or ['']
        return bool(os.path.basename(command[0]) == executable)

    return matches
