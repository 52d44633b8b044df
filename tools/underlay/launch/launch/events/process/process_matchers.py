# SPDX-License-Identifier: Apache-2.0
"""Functions that tell whether an event belongs to a process."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


def matches_pid(pid: int) -> Callable[[ExecuteLocal], bool]:
    """
    Create a matcher of the process that has an id.

    Parameters
    ----------
    pid
        The id that the operating system gave the process.

    Returns
    -------
    callable
        Takes an action, and returns whether it has started that process.

    """
    return lambda action: bool((action.process_details or {}).get('pid') == pid)


def matches_name(name: str) -> Callable[[ExecuteLocal], bool]:
    """
    Create a matcher of the processes that have a label.

    Parameters
    ----------
    name
        The label with its number, such as `talker-1`.

    Returns
    -------
    callable
        Takes an action, and returns whether its process has the label.

    """
    return lambda action: bool(action.name == name)


def matches_executable(executable: str) -> Callable[[ExecuteLocal], bool]:
    """
    Create a matcher of the processes that run a program.

    Parameters
    ----------
    executable
        The file name of the program, without its folder.

    Returns
    -------
    callable
        Takes an action, and returns whether its command begins with the program.

    """

    def matches(action: ExecuteLocal) -> bool:
        command = (action.process_details or {}).get('cmd') or ['']
        return bool(os.path.basename(command[0]) == executable)

    return matches
