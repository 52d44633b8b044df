# SPDX-License-Identifier: Apache-2.0
"""Matchers of processes, and what events tell about the actions that run them."""

from __future__ import annotations

from collections.abc import Callable
import os
from typing import Any, Optional, Protocol


class ProcessAction(Protocol):
    """An action that runs a process, such as `ExecuteLocal`, as the events of it know it."""

    @property
    def name(self) -> Any:
        """Return the label of the process once it is known."""

    @property
    def process_details(self) -> Optional[dict[str, Any]]:
        """Return name, cmd, cwd, env and pid of the process, None before the execution."""


def matches_pid(pid: int) -> Callable[[ProcessAction], bool]:
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


def matches_name(name: str) -> Callable[[ProcessAction], bool]:
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


def matches_executable(executable: str) -> Callable[[ProcessAction], bool]:
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

    def matches(action: ProcessAction) -> bool:
        command = (action.process_details or {}).get('cmd') or ['']
        return bool(os.path.basename(command[0]) == executable)

    return matches
