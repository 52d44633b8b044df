# SPDX-License-Identifier: Apache-2.0
"""The path of a program."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch._checks.programs import find_program
from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class FindExecutable(Substitution):
    """
    Substitution of the path of a program that the shell would find.

    Parameters
    ----------
    name
        The name of the program.

    """

    is_constant = True
    frontend_required = ('name',)

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        self.__name = normalize_to_list_of_substitutions(name)

    @property
    def name(self) -> list[Substitution]:
        """Return the name as a list of substitutions."""
        return self.__name

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'FindExec({" + ".join(sub.describe() for sub in self.__name)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the path of the program.

        Parameters
        ----------
        context
            The launch context, in which the name is performed.

        Raises
        ------
        SubstitutionFailure
            The program is not on the PATH.

        """
        name = perform_substitutions(context, self.__name)
        found = find_program(name)
        if found is None:
            raise SubstitutionFailure(
                f"executable '{name}' not found on the PATH; install it, or source the "
                'environment that has it'
            )
        return found
