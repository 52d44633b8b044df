# SPDX-License-Identifier: Apache-2.0
"""The interpreters in the shebang lines of installed scripts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
import os
from pathlib import Path
import shutil

from ros2doctor.facts.prefix import environment_prefix, is_own

LONGEST_LINE = 512
INSTALL = 'install'


@dataclass(frozen=True)
class Script:
    """
    Program with a shebang line.

    :param is_fixed: whether the interpreter is named by its path, and not looked up in PATH
    :param exists: whether there is such an interpreter
    :param is_python: whether it is a Python
    :param is_own: whether it is that of this environment
    :param workspace: the folder in which colcon has installed the program, if it has
    """

    path: str
    interpreter: str
    is_fixed: bool
    exists: bool
    is_python: bool
    is_own: bool
    workspace: Path | None = None


def read_scripts() -> list[Script]:
    """Return the scripts among the executables of all packages, and the commands themselves."""
    return [script for path in _paths() if (script := read_script(path))]


def read_script(path: Path) -> Script | None:
    """
    Read the interpreter of a script from its shebang line (`#!`).

    Parameters
    ----------
    path
        The path of a file, which need not exist.

    Returns
    -------
    Script or None
        None if the file cannot be read or is not a script.

    """
    try:
        with path.open('rb') as stream:
            line = os.fsdecode(stream.readline(LONGEST_LINE)).strip()
    except OSError:
        return None
    words = line[2:].split() if line.startswith('#!') else []
    if not words:
        return None
    is_fixed = os.path.basename(words[0]) != 'env'
    program = words[0] if is_fixed else shutil.which(words[-1]) or words[-1]
    return Script(
        path=str(path),
        interpreter=program,
        is_fixed=is_fixed,
        exists=os.path.exists(program),
        is_python=os.path.basename(program).startswith('python'),
        is_own=is_own(program),
        workspace=_workspace(path),
    )


def _workspace(path: Path) -> Path | None:
    """Return the workspace whose install folder contains a program."""
    return next((each.parent for each in path.parents if each.name == INSTALL), None)


def _paths() -> Iterator[Path]:
    from ros2pkg.api import get_executable_paths, get_package_names
    from ros_environment.installed import prefixes

    for name in ('ros2', 'colcon', 'pytest'):
        yield Path(environment_prefix(), 'bin', name)
    for package in get_package_names() if prefixes() else ():
        yield from map(Path, get_executable_paths(package_name=package))
