# SPDX-License-Identifier: Apache-2.0
"""The states of a node of a behavior tree, as BehaviorTree.CPP names them."""

from __future__ import annotations

import enum
from typing import NamedTuple

from nav2_util.errors import NavigationError
from py_trees.common import Status

__all__ = ['Failure', 'NodeStatus', 'StatusChange', 'TreeError']


class NodeStatus(enum.Enum):
    """What a tick has told, or that nothing goes on."""

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
"""What py_trees calls the same; it has no word for nodes that are skipped."""


class StatusChange(NamedTuple):
    """A node has got another state: when (s of the tree's clock), which one, from what to what."""

    time_s: float
    name: str
    uid: int
    previous: NodeStatus
    current: NodeStatus


class Failure(NamedTuple):
    """Why a node failed: its name, the error code of its action or 0, and a sentence."""

    name: str
    code: int
    message: str


class TreeError(NavigationError):
    """
    A behavior tree is not right.

    Parameters
    ----------
    message
        What is wrong, as a sentence.
    file, line
        Where; line 0 if that is not known.

    """

    def __init__(self, message: str, file: str = '', line: int = 0) -> None:
        where = f'{file}:{line}: ' if file and line else f'{file}: ' if file else ''
        super().__init__(f'{where}{message}')
        self.file, self.line = file, line
