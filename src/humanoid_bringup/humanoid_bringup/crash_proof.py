# SPDX-License-Identifier: Apache-2.0
"""Start a process anew that has crashed, but not one that somebody has closed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Optional

from launch import Action, LaunchContext, SomeSubstitutionsType, Substitution
from launch.actions import TimerAction
from launch.events.process import ProcessExited
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.actions import Node

__all__ = ['Once', 'crash_proof']

_DELAY_S = 2.0
_MOST = 5


class Once(Substitution):
    """
    Stands for what others stand for when they are first looked at.

    A process that is started later is out of the scope in which a launch file was included, and
    with that of its arguments.

    Parameters
    ----------
    wrapped
        The others.

    """

    def __init__(self, *wrapped: SomeSubstitutionsType) -> None:
        super().__init__()
        self._wrapped = [
            each for one in wrapped for each in normalize_to_list_of_substitutions(one)
        ]
        self._text: str | None = None

    def describe(self) -> str:
        """Return a short description for people."""
        return f'Once({", ".join(each.describe() for each in self._wrapped)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Resolve the substitutions at the first call, and return the same text ever after.

        Parameters
        ----------
        context
            The context of the launch; only that of the first call counts.

        """
        if self._text is None:
            self._text = perform_substitutions(context, self._wrapped)
        return self._text


def crash_proof(make: Callable[..., Node], most: int = _MOST) -> Node:
    """
    Return a node that is started anew after it has ended with an error or by a signal.

    `respawn=True` would also bring back a window that was closed.

    Parameters
    ----------
    make
        Makes the node, with the keyword arguments that it gets; its substitutions are `Once`.
    most
        How often it is started anew at most.

    """

    def react(event: ProcessExited, context: LaunchContext) -> Optional[list[Action]]:
        if event.returncode == 0 or context.is_shutdown or not most:
            return None
        return [TimerAction(period=_DELAY_S, actions=[crash_proof(make, most - 1)])]

    options: dict[str, Any] = {'on_exit': react}
    return make(**options)
