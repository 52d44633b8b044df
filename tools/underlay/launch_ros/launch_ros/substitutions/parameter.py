# SPDX-License-Identifier: Apache-2.0
"""Substitution for the value of a global parameter."""

from __future__ import annotations

from typing import Optional

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


class Parameter(Substitution):
    """
    Stands for the value of a parameter that SetParameter has set in this scope.

    Parameters
    ----------
    name
        The name of the parameter.
    default
        The value if the parameter is not set; None makes that an error.

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
        """Return the parameter name, as substitutions."""
        return self.__name

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'Parameter({" + ".join(sub.describe() for sub in self.__name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the value as a string, or the default if it is not set.

        If several values were set for the same name, the first one is used.

        Parameters
        ----------
        context
            The launch context; its configuration `global_params` holds the global parameters.

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
