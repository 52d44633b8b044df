# SPDX-License-Identifier: Apache-2.0
"""Installed packages with their prefixes, share folders and executables; why one is not found."""

from __future__ import annotations

from collections.abc import Iterator
import os

from ament_index_python.packages import get_package_prefix as _get_package_prefix
from ament_index_python.packages import get_packages_with_prefixes, PackageNotFoundError

__all__ = [
    'PackageNotFoundError',
    'get_executable_paths',
    'get_executable_paths_of_all',
    'get_package_names',
    'get_package_prefix',
    'get_share_directory',
    'missing_package',
    'missing_package_by_name',
]


def get_package_names() -> list[str]:
    """Return the names of all packages, sorted."""
    return sorted(get_packages_with_prefixes())


def get_package_prefix(package_name: str) -> str:
    """
    Find the install prefix of a package.

    Parameters
    ----------
    package_name
        The package.

    Returns
    -------
    str
        The folder that contains the package's `share` and `lib`.

    Raises
    ------
    PackageNotFoundError
        The package is not installed, or its name is not valid.

    """
    try:
        return str(_get_package_prefix(package_name))
    except ValueError as error:
        raise PackageNotFoundError(str(error)) from None


def get_share_directory(package_name: str) -> str:
    """
    Find the share directory of a package.

    Parameters
    ----------
    package_name
        The package.

    Returns
    -------
    str
        The path `<prefix>/share/<package_name>`, whether it exists or not.

    Raises
    ------
    PackageNotFoundError
        As for `get_package_prefix`.

    """
    return os.path.join(get_package_prefix(package_name), 'share', package_name)


def get_executable_paths(*, package_name: str) -> list[str]:
    """
    List the executables of a package: those in `lib/<package_name>` and below.

    Hidden subfolders are left out.

    Parameters
    ----------
    package_name
        The package.

    Returns
    -------
    list of str
        Their paths, sorted.

    Raises
    ------
    PackageNotFoundError
        As for `get_package_prefix`.

    """
    return _executables(get_package_prefix(package_name), package_name)


def get_executable_paths_of_all() -> dict[str, list[str]]:
    """Return the paths of the executables of each package, all sorted."""
    found = sorted(get_packages_with_prefixes().items())
    return {package: _executables(prefix, package) for package, prefix in found}


def _executables(prefix: str, package: str) -> list[str]:
    return sorted(_walk(os.path.join(prefix, 'lib', package)))


def _walk(folder: str) -> Iterator[str]:
    """Yield the executable files in a folder and in those below it that are not hidden."""
    try:
        entries = os.scandir(folder)
    except OSError:  # most packages have no such folder
        return
    with entries:
        for entry in entries:
            if not entry.is_dir():
                if os.access(entry.path, os.X_OK):
                    yield entry.path
            elif not entry.is_symlink() and not entry.name.startswith('.'):
                yield from _walk(entry.path)


def missing_package(package: str) -> str:
    """
    Format the error message of `prefix` and `xml` for a package that is not found.

    Parameters
    ----------
    package
        The package as the user wrote it.

    Returns
    -------
    str
        A line without the name, then the cause and the remedy if they are known.

    """
    from ros_environment.workspace import explain_missing_package

    return '\n'.join(['Package not found', explain_missing_package(package)]).rstrip()


def missing_package_by_name(package: str, detail: str = '') -> str:
    """
    Format the error message that names a package that is not found.

    Parameters
    ----------
    package
        The package as the user wrote it.
    detail
        A detail to append to the first line, after a colon.

    Returns
    -------
    str
        The line with the name, then the cause and the remedy if they are known.

    """
    from ros_environment.workspace import explain_missing_package

    text = f"Package '{package}' not found" + (f': {detail}' if detail else '')
    return '\n'.join([text, explain_missing_package(package)]).rstrip()
