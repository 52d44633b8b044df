# SPDX-License-Identifier: Apache-2.0
"""The status of a node, as BehaviorTree.CPP names it."""

from __future__ import annotations

import enum
from typing import NamedTuple

from nav2_util.errors import NavigationError
from py_trees.common import Status

__all__ = ['Failure', 'NodeStatus', 'StatusChange', 'TreeError']


class NodeStatus(enum.Enum):
    """Status of a node: the result of a tick, or IDLE."""

    IDLE = 'IDLE'
    RUNNING = 'RUNNING'
    SUCCESS = 'SUCCESS'
    FAILURE = 'FAILURE'
    SKIPPED = 'SKIPPED'


PY_TREES_STATUS = {
    NodeStatus.IDLE: Status.INVALID,
    NodeStatus.RUNNING: Status.RUNNING,
    NodeStatus.SUCCESS: Status.SUCCESS,
    NodeStatus.FAILURE: Status.FAILURE,
    NodeStatus.SKIPPED: Status.INVALID,
}
"""The corresponding py_trees statuses; py_trees has none for skipped nodes."""


class StatusChange(NamedTuple):
    """Status change of a node: time (s of the tree's clock), node, previous and new status."""

    time_s: float
    name: str
    uid: int
    previous: NodeStatus
    current: NodeStatus


class Failure(NamedTuple):
    """Failure of a node: its name, the error code of its action or 0, and a message."""

    name: str
    code: int
    message: str


class TreeError(NavigationError):
    """
    Error in a behavior tree.

    Parameters
    ----------
    message
        The error message, a full sentence.
    file, line
        Its location; line 0 if unknown.

    """

    def __init__(self, message: str, file: str = '', line: int = 0) -> None:
        where = f'{file}:{line}: ' if file and line else f'{file}: ' if file else ''
        super().__init__(f'{where}{message}')
        self.file, self.line = file, line
