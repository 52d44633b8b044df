# SPDX-License-Identifier: Apache-2.0
"""Substitutions for what a package has installed: its folders, and its executables."""

from __future__ import annotations

import os
from typing import ClassVar

from ament_index_python.packages import get_package_prefix, PackageNotFoundError
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.substitutions import SubstitutionFailure
from launch.substitutions.path_join_substitution import PathOperator
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions


class FindPackage(PathOperator):
    """
    The base of the substitutions that stand for a folder of a package.

    Parameters
    ----------
    package
        The name of the package.

    """

    is_constant = True
    frontend_required: ClassVar[tuple[str, ...]] = ('package',)

    def __init__(self, package: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__package = normalize_to_list_of_substitutions(package)

    @property
    def package(self) -> list[Substitution]:
        """Return the package name, as substitutions."""
        return self.__package

    def describe(self) -> str:
        """Return a short human-readable description."""
        package = ' + '.join(sub.describe() for sub in self.__package)
        return f'{type(self).__name__}(pkg={package})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the directory of the package.

        Parameters
        ----------
        context
            The launch context used to perform substitutions in the package name.

        Raises
        ------
        PackageNotFoundError
            The package is not installed.

        """
        return self.find(perform_substitutions(context, self.__package))

    def find(self, package_name: str) -> str:
        """
        Return the directory of a package; to be overridden by subclasses.

        Parameters
        ----------
        package_name
            The name of the package, as a string.

        """
        raise NotImplementedError


class FindPackagePrefix(FindPackage):
    """Stands for the folder that a package is installed to."""

    def find(self, package_name: str) -> str:
        """
        Return the install prefix of a package.

        Parameters
        ----------
        package_name
            The name of the package.

        Raises
        ------
        PackageNotFoundError
            The package is not installed.

        """
        return prefix_of(package_name)


class FindPackageShare(FindPackagePrefix):
    """Stands for the folder of the files that a package shares."""

    def find(self, package_name: str) -> str:
        """
        Return the share directory of a package.

        Parameters
        ----------
        package_name
            The name of the package.

        Raises
        ------
        PackageNotFoundError
            The package is not installed.

        """
        prefix: str = super().find(package_name)
        return os.path.join(prefix, 'share', package_name)


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


class _ExplainedPackageNotFoundError(PackageNotFoundError):
    """A package was not found; the message states why, as far as known."""

    def __init__(self, error: KeyError, explanation: str) -> None:
        super().__init__(*error.args)
        self._text = '\n'.join(filter(None, [str(error), explanation]))

    def __str__(self) -> str:
        return self._text


def prefix_of(package_name: str) -> str:
    """
    Return the install prefix of a package.

    Parameters
    ----------
    package_name
        The package.

    Raises
    ------
    PackageNotFoundError
        It is not installed; the message states why, as far as the workspace shows.

    """
    try:
        return str(get_package_prefix(package_name))
    except PackageNotFoundError as error:
        raise _ExplainedPackageNotFoundError(error, _why_missing(package_name)) from None


def _why_missing(package_name: str) -> str:
    """Explain a missing package from the workspace around the current directory."""
    from ros_environment.workspace import explain_missing_package

    return explain_missing_package(package_name)
