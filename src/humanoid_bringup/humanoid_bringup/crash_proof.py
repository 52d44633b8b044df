# SPDX-License-Identifier: Apache-2.0
"""Respawn a process that has crashed, but not one that was closed by the user."""

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
    Substitution that is performed only once: later calls return the same text.

    A process that is respawned is outside of the scope in which its launch file was included, and
    so outside of the scope of the launch arguments.

    Parameters
    ----------
    wrapped
        The substitutions to perform.

    """

    def __init__(self, *wrapped: SomeSubstitutionsType) -> None:
        super().__init__()
        self._wrapped = [
            each for one in wrapped for each in normalize_to_list_of_substitutions(one)
        ]
        self._text: str | None = None

    def describe(self) -> str:
        """Return a human-readable description."""
        return f'Once({", ".join(each.describe() for each in self._wrapped)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Perform the substitutions at the first call, and return the same text afterwards.

        Parameters
        ----------
        context
            The launch context; only that of the first call is used.

        """
        if self._text is None:
            self._text = perform_substitutions(context, self._wrapped)
        return self._text


def crash_proof(make: Callable[..., Node], most: int = _MOST) -> Node:
    """
    Return a node that is respawned after it has ended with an error or by a signal.

    `respawn=True` would also bring back a window that was closed.

    Parameters
    ----------
    make
        Makes the node, passing on its keyword arguments; the substitutions must be `Once`.
    most
        Maximum number of respawns.

    """

    def react(event: ProcessExited, context: LaunchContext) -> Optional[list[Action]]:
        if event.returncode == 0 or context.is_shutdown or not most:
            return None
        return [TimerAction(period=_DELAY_S, actions=[crash_proof(make, most - 1)])]

    options: dict[str, Any] = {'on_exit': react}
    return make(**options)
