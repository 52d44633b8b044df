# SPDX-License-Identifier: Apache-2.0
"""Substitutions for the install directories of ROS packages."""

from __future__ import annotations

import os
from typing import ClassVar

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
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
        from launch_ros.substitutions._installed_package import prefix_of

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
