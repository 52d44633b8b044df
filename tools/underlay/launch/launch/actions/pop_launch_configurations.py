# SPDX-License-Identifier: Apache-2.0
"""The action that closes a scope of launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PopLaunchConfigurations(Action):
    """Restores the launch configurations that PushLaunchConfigurations kept."""

    def execute(self, context: LaunchContext) -> None:
        """
        Restore the launch configurations of the last `PushLaunchConfigurations`.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        RuntimeError
            Nothing has been pushed.

        """
        context._pop_launch_configurations()
