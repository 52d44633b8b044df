# SPDX-License-Identifier: Apache-2.0
"""A choice between two strings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.type_utils import read_boolean

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class IfElseSubstitution(Substitution):
    """
    Substitution of one of two texts; only the one that is chosen is performed.

    Parameters
    ----------
    condition
        The condition, which must resolve to a boolean.
    if_value
        The text if it is true.
    else_value
        The text if it is false.

    Raises
    ------
    RuntimeError
        Both strings are empty.

    """

    frontend_required = ('condition',)
    frontend_optional = ('if_value', 'else_value')

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = '',
        else_value: SomeSubstitutionsType = '',
    ) -> None:
        if if_value == else_value == '':
            raise RuntimeError(
                'IfElseSubstitution needs an if_value or an else_value, but both are empty'
            )
        self.__condition = normalize_to_list_of_substitutions(condition)
        self.__if_value = normalize_to_list_of_substitutions(if_value)
        self.__else_value = normalize_to_list_of_substitutions(else_value)

    @property
    def condition(self) -> list[Substitution]:
        """Return the condition as a list of substitutions."""
        return self.__condition

    @property
    def if_value(self) -> list[Substitution]:
        """Return the value for a true condition as a list of substitutions."""
        return self.__if_value

    @property
    def else_value(self) -> list[Substitution]:
        """Return the value for a false condition as a list of substitutions."""
        return self.__else_value

    def describe(self) -> str:
        """Return a short human-readable description."""
        parts = (
            ' + '.join(sub.describe() for sub in each)
            for each in (self.__condition, self.__if_value, self.__else_value)
        )
        return f'IfElseSubstitution({", ".join(parts)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the string that the condition selects.

        Parameters
        ----------
        context
            The launch context, in which condition and text are performed.

        Raises
        ------
        SubstitutionFailure
            The condition is not a boolean.

        """
        condition = perform_substitutions(context, self.__condition)
        try:
            chosen = self.__if_value if read_boolean(condition) else self.__else_value
        except ValueError as error:
            raise SubstitutionFailure(f'{self.describe()}: {error}') from error
        return perform_substitutions(context, chosen)
