# SPDX-License-Identifier: Apache-2.0
"""Complete the names of packages and executables."""

from __future__ import annotations

import argparse
import os

from ament_index_python.packages import get_packages_with_prefixes, PackageNotFoundError


def packages(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of all packages.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    return sorted(get_packages_with_prefixes())


def packages_with_executables(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of the packages that have executables.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    return sorted(
        name
        for name, folder in get_packages_with_prefixes().items()
        if os.path.isdir(os.path.join(folder, 'lib', name))
    )


def executables(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the names of a package's executables.

    Parameters
    ----------
    prefix
        The word to complete (unused).
    args : argparse.Namespace
        The parsed arguments, with the `package_name`.

    """
    from ros2pkg.api import get_executable_paths

    try:
        paths = get_executable_paths(package_name=args.package_name)
    except PackageNotFoundError:
        return []
    return sorted(map(os.path.basename, paths))


def licenses(prefix: str, args: argparse.Namespace) -> list[str]:
    """
    List the licences whose text is available for a new package.

    Parameters
    ----------
    prefix, args
        The word to complete and the parsed arguments (both unused).

    """
    from ros2pkg.create.licenses import known_licenses

    return known_licenses()
