# SPDX-License-Identifier: Apache-2.0
"""The action that undoes all changes of the environment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class ResetEnvironment(Action):
    """Restores the environment that the launch was started with."""

    def execute(self, context: LaunchContext) -> None:
        """
        Restore the environment that the launch was started with.

        Parameters
        ----------
        context
            The launch context.

        """
        context._reset_environment()
