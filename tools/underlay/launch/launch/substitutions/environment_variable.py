# SPDX-License-Identifier: Apache-2.0
"""The value of an environment variable."""

from __future__ import annotations

from typing import Optional, TYPE_CHECKING

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class EnvironmentVariable(Substitution):
    """
    Substitution of the value that an environment variable has at run time.

    Parameters
    ----------
    name
        The name of the variable.
    default_value
        The value if it is not set; without a default, an unset variable is an error.

    """

    frontend_required = ('name',)
    frontend_optional = ('default_value',)

    def __init__(
        self,
        name: SomeSubstitutionsType,
        *,
        default_value: Optional[SomeSubstitutionsType] = None,
    ) -> None:
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    @property
    def default_value(self) -> Optional[list[Substitution]]:
        """Return the default as a list of substitutions, or None."""
        return self.__default_value

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'EnvVar({" + ".join(sub.describe() for sub in self.__name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the value of the environment variable, or else the default.

        Parameters
        ----------
        context
            The launch context, whose environment is read.

        Raises
        ------
        SubstitutionFailure
            The variable is not set, and there is no default.

        """
        name = perform_substitutions(context, self.__name)
        value = context.environment.get(name)
        if value is not None:
            return value
        if self.__default_value is None:
            raise SubstitutionFailure(f"environment variable '{name}' does not exist")
        return perform_substitutions(context, self.__default_value)
