# SPDX-License-Identifier: Apache-2.0
"""Matchers of processes."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


def matches_pid(pid: int) -> Callable[[ExecuteLocal], bool]:
    """
    Create a matcher of a process by its id.

    Parameters
    ----------
    pid
        The process id.

    Returns
    -------
    callable
        Predicate that accepts an action, and returns whether it has started that process.

    """
    return lambda action: bool((action.process_details or {}).get('pid') == pid)


def matches_name(name: str) -> Callable[[ExecuteLocal], bool]:
    """
    Create a matcher of processes by label.

    Parameters
    ----------
    name
        The label with its number, such as `talker-1`.

    Returns
    -------
    callable
        Predicate that accepts an action, and returns whether its process has the label.

    """
    return lambda action: bool(action.name == name)


def matches_executable(executable: str) -> Callable[[ExecuteLocal], bool]:
    """
    Create a matcher of processes by the program that they run.

    Parameters
    ----------
    executable
        The file name of the program, without its directory.

    Returns
    -------
    callable
        Predicate that accepts an action, and returns whether its command starts with the program.

    """

    def matches(action: ExecuteLocal) -> bool:
        command = (action.process_details or {}).get('cmd') or ['']
        return bool(os.path.basename(command[0]) == executable)

    return matches
