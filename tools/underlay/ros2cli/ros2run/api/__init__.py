# SPDX-License-Identifier: Apache-2.0
"""Find executables of packages and run them as child processes that never outlive the command."""

from __future__ import annotations

import os

from ros2run.api.child import run_child

__all__ = ['MultipleExecutables', 'get_executable_path', 'run_executable']


class MultipleExecutables(Exception):
    """Several executables of a package have the same name."""

    def __init__(self, paths: list[str]) -> None:
        """Initialize with the found paths."""
        super().__init__(', '.join(paths))
        self.paths = paths


def get_executable_path(*, package_name: str, executable_name: str) -> str | None:
    """
    Find an executable of a package by its file name.

    Parameters
    ----------
    package_name, executable_name
        The package, and the name of the file in or below its `lib/<package_name>`.

    Returns
    -------
    str or None
        The path, or None if the package has no such executable.

    Raises
    ------
    PackageNotFoundError
        The package is not installed.
    MultipleExecutables
        Several executables have this name.

    """
    from ros2pkg.api import get_executable_paths

    paths = [
        path
        for path in get_executable_paths(package_name=package_name)
        if os.path.basename(path) == executable_name
    ]
    if len(paths) > 1:
        raise MultipleExecutables(paths)
    return paths[0] if paths else None


def run_executable(*, path: str, argv: list[str], prefix: list[str] | None = None) -> int:
    """
    Run an executable in the foreground until it exits.

    Parameters
    ----------
    path
        The executable.
    argv
        Its arguments.
    prefix
        The prefix command, such as `gdb -ex run --args`, as a list of words.

    Returns
    -------
    int
        The exit status, or the negative number of the signal that terminated it.

    Raises
    ------
    RuntimeError
        The executable, or the first word of the prefix, cannot be run.

    """
    return run_child([*(prefix or ()), path, *argv])
