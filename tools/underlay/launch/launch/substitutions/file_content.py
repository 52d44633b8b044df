# SPDX-License-Identifier: Apache-2.0
"""The content of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution, SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext


class FileContent(Substitution):
    """
    Substitution of the text in a file.

    Parameters
    ----------
    path
        The path of the file, which is read as UTF-8.

    """

    frontend_required = ('path',)

    def __init__(self, path: SomeSubstitutionsType) -> None:
        self.__path = normalize_to_list_of_substitutions(path)

    @property
    def path(self) -> list[Substitution]:
        """Return the path as a list of substitutions."""
        return self.__path

    def describe(self) -> str:
        """Return a short human-readable description."""
        return f'FileContent({" + ".join(sub.describe() for sub in self.__path)})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the contents of the file.

        Parameters
        ----------
        context
            The launch context, in which the path is performed.

        Raises
        ------
        SubstitutionFailure
            The file does not exist, or cannot be read.

        """
        path = perform_substitutions(context, self.__path)
        context.run.note_file(path)
        try:
            with open(path, encoding='utf-8') as file:
                return file.read()
        except FileNotFoundError as error:
            from ros_environment.missing_file import explain_missing_file

            advice = explain_missing_file('file', path)
            raise SubstitutionFailure(f'File not found: {path}\n{advice}') from error
        except (OSError, UnicodeDecodeError) as error:
            raise SubstitutionFailure(f'File cannot be read: {path}: {error}') from error
