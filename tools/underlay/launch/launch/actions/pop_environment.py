# SPDX-License-Identifier: Apache-2.0
"""The action that closes a scope of the environment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PopEnvironment(Action):
    """Restores the environment that PushEnvironment kept."""

    def execute(self, context: LaunchContext) -> None:
        """
        Restore the environment of the last `PushEnvironment`.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        RuntimeError
            Nothing has been pushed.

        """
        context._pop_environment()
