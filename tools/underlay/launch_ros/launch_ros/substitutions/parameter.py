# SPDX-License-Identifier: Apache-2.0
"""The value of a parameter that was set for all nodes."""

from __future__ import annotations

from typing import Optional

from launch.launch_context import LaunchContext
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities.normalize_to_list_of_substitutions_impl import (
    normalize_to_list_of_substitutions,
)
from launch.utilities.perform_substitutions_impl import perform_substitutions


class Parameter(Substitution):
    """
    Stands for the value of a parameter that SetParameter has set in this scope.

    Parameters
    ----------
    name
        The name of the parameter.
    default
        What it stands for if the parameter is not set; None makes that a failure.

    """

    frontend_required = ('name',)
    frontend_optional = ('default',)

    def __init__(
        self,
        name: SomeSubstitutionsType,
        *,
        default: Optional[SomeSubstitutionsType] = None,
    ) -> None:
        super().__init__()
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default = None if default is None else normalize_to_list_of_substitutions(default)

    @property
    def name(self) -> list[Substitution]:
        """Return the parts of the name."""
        return self.__name

    def describe(self) -> str:
        """Return a short description for people."""
        return f'Parameter({" + ".join(sub.describe() for sub in self.__name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the value as text, or else the default.

        Of several values that were set for the same name, the first one counts.

        Parameters
        ----------
        context
            Its launch configuration `global_params` holds the parameters of all nodes.

        Raises
        ------
        SubstitutionFailure
            The parameter is not set in this scope, and there is no default.

        """
        name = perform_substitutions(context, self.__name)
        for item in context.launch_configurations.get('global_params', []):
            if isinstance(item, tuple) and item[0] == name:
                return str(item[1])
        if self.__default is not None:
            return perform_substitutions(context, self.__default)
        raise SubstitutionFailure(
            f"parameter '{name}' not found: no SetParameter has set it in this scope"
        )
