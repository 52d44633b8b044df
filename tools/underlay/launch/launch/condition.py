# SPDX-License-Identifier: Apache-2.0
"""The base class of all conditions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Optional, TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Condition:
    """A question that decides at run time whether an action is executed."""

    def __init__(self, *, predicate: Optional[Callable[[LaunchContext], bool]] = None) -> None:
        """Create a condition that asks `predicate`; without one it is never fulfilled."""
        self._predicate = predicate

    def describe(self) -> str:
        """Return a short description for people."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether the condition is fulfilled now."""
        return self._predicate(context) if self._predicate is not None else False
