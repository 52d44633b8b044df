# SPDX-License-Identifier: Apache-2.0
"""The action that removes a launch configuration."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING

from launch.action import Action
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class UnsetLaunchConfiguration(Action):
    """
    Action that removes a launch configuration if it is set.

    Parameters
    ----------
    name
        The name of the configuration.
    **kwargs
        Keyword arguments of `Action`.

    """

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    def execute(self, context: LaunchContext) -> None:
        """
        Remove the launch configuration.

        Parameters
        ----------
        context
            The launch context, in which the name is performed.

        """
        context.launch_configurations.pop(perform_substitutions(context, self.__name), None)
