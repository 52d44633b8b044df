# SPDX-License-Identifier: Apache-2.0
"""The base class of all conditions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Optional, TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class Condition:
    """
    Base class of conditions: a question that decides whether an action is executed.

    Parameters
    ----------
    predicate
        Called with the launch context; without one the condition is never fulfilled.

    """

    def __init__(self, *, predicate: Optional[Callable[[LaunchContext], bool]] = None) -> None:
        self._predicate = predicate

    def describe(self) -> str:
        """Return a short human-readable description."""
        return repr(self)

    def evaluate(self, context: LaunchContext) -> bool:
        """
        Evaluate the condition in the current state of the launch.

        Parameters
        ----------
        context
            The launch context, which is passed to the predicate.

        Returns
        -------
        bool
            Whether the condition is fulfilled.

        """
        return self._predicate(context) if self._predicate is not None else False
