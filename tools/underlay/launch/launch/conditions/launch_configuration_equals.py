# SPDX-License-Identifier: Apache-2.0
"""A condition that compares a launch configuration with a string."""

from __future__ import annotations

from typing import Optional, TYPE_CHECKING
import warnings

from launch.condition import Condition
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class LaunchConfigurationEquals(Condition):
    """
    Condition that is fulfilled if a launch configuration has a value.

    Deprecated, with a warning: use `IfCondition(EqualsSubstitution(...))` instead.

    Parameters
    ----------
    launch_configuration_name
        The name of the configuration.
    expected_value
        The string or substitutions to compare with; None for a configuration that is not set.

    """

    def __init__(
        self,
        launch_configuration_name: str,
        expected_value: Optional[SomeSubstitutionsType],
    ) -> None:
        self._name = launch_configuration_name
        self._expected = (
            None if expected_value is None else normalize_to_list_of_substitutions(expected_value)
        )
        super().__init__(predicate=self._predicate_func)
        warnings.warn(
            f'{type(self).__name__} is deprecated; write '
            "IfCondition(EqualsSubstitution(LaunchConfiguration('name'), 'value')) instead, or "
            'with NotEqualsSubstitution',
            UserWarning,
            stacklevel=2,
        )

    def describe(self) -> str:
        """Return a short human-readable description."""
        expected = ' + '.join(sub.describe() for sub in self._expected or ()) or None
        return f"{type(self).__name__}('{self._name}', {expected})"

    def _equals(self, context: LaunchContext) -> bool:
        value = context.launch_configurations.get(self._name)
        if context._observer is not None:
            context._observer.expanded('not set' if value is None else str(value))
        if self._expected is None or value is None:
            return value is None and self._expected is None
        return str(value) == perform_substitutions(context, self._expected)

    def _predicate_func(self, context: LaunchContext) -> bool:
        return self._equals(context)
