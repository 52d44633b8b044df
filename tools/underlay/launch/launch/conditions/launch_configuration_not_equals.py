# SPDX-License-Identifier: Apache-2.0
"""A condition that is fulfilled if a launch configuration differs from a string."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.conditions.launch_configuration_equals import LaunchConfigurationEquals

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Fulfilled if a launch configuration does not have a value."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not self._equals(context)
