# SPDX-License-Identifier: Apache-2.0
"""Captured scope of actions that are executed later."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class EnterScope(LaunchDescriptionEntity):
    """
    Entity that opens a scope with captured launch configurations.

    Parameters
    ----------
    configurations
        The captured launch configurations, which replace the current ones.
    local_variables
        The captured local variables, which are added to the current ones; `event` is kept.

    """

    def __init__(self, configurations: dict[str, Any], local_variables: dict[str, Any]) -> None:
        self._configurations = configurations
        self._locals = local_variables

    def visit(self, context: LaunchContext) -> None:
        """
        Replace the launch configurations until `LeaveScope` is visited.

        Parameters
        ----------
        context
            The launch context.

        """
        context._push_launch_configurations()
        context.launch_configurations.clear()
        context.launch_configurations.update(self._configurations)
        event = context.get_locals_as_dict().get('event')
        context.extend_locals({**self._locals, 'event': event})


class LeaveScope(LaunchDescriptionEntity):
    """Entity that closes the scope."""

    def visit(self, context: LaunchContext) -> None:
        """
        Restore the launch configurations from before the scope.

        Parameters
        ----------
        context
            The launch context.

        """
        context._pop_launch_configurations()
