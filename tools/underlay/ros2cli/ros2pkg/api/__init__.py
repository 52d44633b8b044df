# SPDX-License-Identifier: Apache-2.0
"""What is installed: packages, their prefixes, share folders and executables."""

from __future__ import annotations

from collections.abc import Iterator
import os

from ament_index_python.packages import get_package_prefix as _get_package_prefix
from ament_index_python.packages import get_packages_with_prefixes, PackageNotFoundError

__all__ = [
    'PackageNotFoundError',
    'get_executable_paths',
    'get_package_names',
    'get_package_prefix',
    'get_share_directory',
]


def get_package_names() -> list[str]:
    """Return the names of all packages, sorted."""
    return sorted(get_packages_with_prefixes())


def get_package_prefix(package_name: str) -> str:
    """Return a package's prefix; a name that cannot exist is a package that does not exist."""
    try:
        return str(_get_package_prefix(package_name))
    except ValueError as error:
        raise PackageNotFoundError(str(error)) from None


def get_share_directory(package_name: str) -> str:
    """Return a package's share directory."""
    return os.path.join(get_package_prefix(package_name), 'share', package_name)


def get_executable_paths(*, package_name: str) -> list[str]:
    """Return the paths of a package's executables, sorted."""
    return sorted(_walk(os.path.join(get_package_prefix(package_name), 'lib', package_name)))


def _walk(top: str) -> Iterator[str]:
    for root, folders, names in os.walk(top):
        folders[:] = [name for name in folders if not name.startswith('.')]
        paths = (os.path.join(root, name) for name in names)
        yield from (path for path in paths if os.access(path, os.X_OK))
