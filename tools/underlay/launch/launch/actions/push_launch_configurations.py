# SPDX-License-Identifier: Apache-2.0
"""The action that opens a scope of launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PushLaunchConfigurations(Action):
    """Keeps the launch configurations until PopLaunchConfigurations restores them."""

    def execute(self, context: LaunchContext) -> None:
        """
        Save a copy of the launch configurations.

        Parameters
        ----------
        context
            The launch context.

        """
        context._push_launch_configurations()
