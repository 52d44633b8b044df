# SPDX-License-Identifier: Apache-2.0
"""The action that opens a scope of the environment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PushEnvironment(Action):
    """Keeps the environment until PopEnvironment restores it."""

    def execute(self, context: LaunchContext) -> None:
        """
        Save a copy of the environment.

        Parameters
        ----------
        context
            The launch context.

        """
        context._push_environment()
