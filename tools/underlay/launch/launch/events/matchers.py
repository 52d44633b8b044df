# SPDX-License-Identifier: Apache-2.0
"""Matchers of actions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TYPE_CHECKING

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal


def matches_action(target_action: ExecuteLocal) -> Callable[[Any], bool]:
    """
    Create a matcher of one action.

    Parameters
    ----------
    target_action
        The action that runs a process.

    Returns
    -------
    callable
        Predicate that accepts an action, and returns whether it is this one.

    """
    return lambda action: action is target_action
