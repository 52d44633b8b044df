# SPDX-License-Identifier: Apache-2.0
"""Paths: a string that is used as one, its parts joined, and what can be joined with `/`."""

from __future__ import annotations

from collections.abc import Iterable
import os
from typing import TYPE_CHECKING

from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class PathOperator(Substitution):
    """Base class of substitutions of paths that can be joined with `/`."""

    def __truediv__(self, other: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return this path joined with another."""
        return PathJoinSubstitution([self, other])


class PathJoinSubstitution(PathOperator):
    """
    Substitution of parts of a path joined by the separator of the system.

    Parameters
    ----------
    substitutions
        The parts; a list is concatenated to one part.

    """

    is_constant = True

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType]) -> None:
        if isinstance(substitutions, (str, os.PathLike, Substitution)):
            substitutions = [substitutions]
        self.__parts = [normalize_to_list_of_substitutions(part) for part in substitutions]

    @property
    def substitutions(self) -> list[list[Substitution]]:
        """Return the parts, each as a list of substitutions."""
        return self.__parts

    def describe(self) -> str:
        """Return a short human-readable description."""
        parts = (' + '.join(sub.describe() for sub in part) for part in self.__parts)
        return f"PathJoin('{' + '.join(parts)}')"

    def perform(self, context: LaunchContext) -> str:
        """
        Return the joined path; an absolute part discards the parts before it.

        Parameters
        ----------
        context
            The launch context, in which the parts are performed.

        """
        parts = [perform_substitutions(context, part) for part in self.__parts]
        return os.path.join(*parts) if parts else ''


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
