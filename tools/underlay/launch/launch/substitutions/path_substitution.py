# SPDX-License-Identifier: Apache-2.0
"""A string that is used as a path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch.substitutions.path_join_substitution import PathOperator
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PathSubstitution(PathOperator):
    """
    Substitution of a path; `/` joins it with more, as it does for pathlib.

    Parameters
    ----------
    path
        The path, as a string or substitutions.

    """

    is_constant = True

    def __init__(self, path: SomeSubstitutionsType) -> None:
        self.__path = normalize_to_list_of_substitutions(path)

    @property
    def path(self) -> list[Substitution]:
        """Return the text as a list of substitutions."""
        return self.__path

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'Path({" + ".join(sub.describe() for sub in self.__path)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the path.

        Parameters
        ----------
        context
            The launch context, in which the path is performed.

        """
        return perform_substitutions(context, self.__path)
