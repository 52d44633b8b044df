# SPDX-License-Identifier: Apache-2.0
"""Find a launch file in the share directory of a package."""

from __future__ import annotations

import os


class MultipleLaunchFilesError(Exception):
    """Several files of a package have the same name."""

    def __init__(self, message: str, paths: list[str]) -> None:
        """Initialize with the found paths."""
        super().__init__(message)
        self.paths = paths


def get_share_file_path_from_package(*, package_name: str, file_name: str | None) -> str:
    """
    Find a file anywhere below the share directory of a package.

    Parameters
    ----------
    package_name
        The name of the package.
    file_name
        The name of the file, without folders; None is never found.

    Returns
    -------
    str
        The path of the file.

    Raises
    ------
    PackageNotFoundError
        There is no such package.
    FileNotFoundError
        The package has no such file.
    MultipleLaunchFilesError
        The package has several files of this name.

    """
    from ros2pkg.api import get_share_directory

    share = get_share_directory(package_name)
    paths = [
        os.path.join(root, file_name)
        for root, _, names in os.walk(share)
        if file_name is not None and file_name in names
    ]
    if not paths:
        raise FileNotFoundError(
            f"file '{file_name}' was not found in the share directory of package "
            f"'{package_name}' which is at '{share}'"
        )
    if len(paths) > 1:
        raise MultipleLaunchFilesError(
            f"file '{file_name}' was found more than once in the share directory of package "
            f"'{package_name}': {paths}",
            paths,
        )
    return paths[0]
