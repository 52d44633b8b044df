# SPDX-License-Identifier: Apache-2.0
"""The scope of an action that comes later."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class EnterScope(LaunchDescriptionEntity):
    """Opens a scope of launch configurations as they were earlier."""

    def __init__(self, configurations: dict[str, Any], local_variables: dict[str, Any]) -> None:
        """Create the entity from what was captured."""
        self._configurations = configurations
        self._locals = local_variables

    def visit(self, context: LaunchContext) -> None:
        """Open the scope."""
        context._push_launch_configurations()
        context.launch_configurations.clear()
        context.launch_configurations.update(self._configurations)
        event = context.get_locals_as_dict().get('event')
        context.extend_locals({**self._locals, 'event': event})


class LeaveScope(LaunchDescriptionEntity):
    """Closes the scope."""

    def visit(self, context: LaunchContext) -> None:
        """Restore the launch configurations."""
        context._pop_launch_configurations()
