# SPDX-License-Identifier: Apache-2.0
"""Substitution for the path of an executable of a package."""

from __future__ import annotations

import os

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.substitutions.find_package import FindPackagePrefix


class ExecutableInPackage(FindPackagePrefix):
    """
    Stands for the path of an executable that a package has installed.

    Parameters
    ----------
    executable
        The file name of the executable.
    package
        The package that installs the executable.

    """

    frontend_required = ('executable', 'package')

    def __init__(
        self,
        executable: SomeSubstitutionsType,
        package: SomeSubstitutionsType,
    ) -> None:
        super().__init__(package)
        self.__executable = normalize_to_list_of_substitutions(executable)

    @property
    def executable(self) -> list[Substitution]:
        """Return the executable name, as substitutions."""
        return self.__executable

    def describe(self) -> str:
        """Return a short human-readable description."""
        package = ' + '.join(sub.describe() for sub in self.package)
        executable = ' + '.join(sub.describe() for sub in self.__executable)
        return f'ExecInPkg(pkg={package}, exec={executable})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the path of the executable below `lib/<package>` of the install prefix.

        Parameters
        ----------
        context
            The launch context used to perform substitutions in the names.

        Raises
        ------
        PackageNotFoundError
            The package is not installed.
        SubstitutionFailure
            The package has no such executable; the message states what is missing.

        """
        executable = perform_substitutions(context, self.__executable)
        package = perform_substitutions(context, self.package)
        prefix = self.find(package)
        folder = os.path.join(prefix, 'lib', package)
        path = os.path.join(folder, executable)
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return path
        problem = (
            f"executable '{executable}' not found on the libexec directory '{folder}' "
            if os.path.isdir(folder)
            else f"package '{package}' found at '{prefix}', but libexec directory "
            f"'{folder}' does not exist"
        )
        explanation = _explain(package, executable, prefix)
        raise SubstitutionFailure('\n'.join(filter(None, [problem, explanation])))


def _explain(package: str, executable: str, prefix: str) -> str:
    """Explain a missing executable from the workspace around the current directory."""
    from ros_environment.workspace import explain_missing_executable

    return explain_missing_executable(package, executable, prefix)
