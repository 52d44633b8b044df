# SPDX-License-Identifier: Apache-2.0
"""Installed files of this package, the choice of a scene among them, and atomic writing."""

from __future__ import annotations

from argparse import ArgumentTypeError
import os
from pathlib import Path

from humanoid_simulation.errors import named, SimulationError

SCENE_SUFFIXES = ('.yaml', '.yml')


def share() -> Path:
    """Return the share directory, with the scenes and the configuration."""
    from ament_index_python.packages import get_package_share_directory

    return Path(get_package_share_directory('humanoid_simulation'))


def installed_scenes() -> dict[str, Path]:
    """Find the files of the installed scenes, by name."""
    return {path.stem: path for path in sorted((share() / 'scenes').glob('*.yaml'))}


def scene_path(name: str) -> Path:
    """
    Find the file of a scene.

    Parameters
    ----------
    name
        The name of an installed scene, or the path of a file that ends with .yaml or .yml.

    Raises
    ------
    SimulationError
        There is no installed scene of that name; a path is returned unchecked.

    """
    if name.endswith(SCENE_SUFFIXES):
        return Path(name)
    return named('scene', name, installed_scenes())


def folder_argument(text: str) -> Path:
    """
    Read an argument of a command line that is a folder, which need not exist.

    Parameters
    ----------
    text
        The argument.

    Raises
    ------
    ArgumentTypeError
        It is empty, which would be the current folder.

    """
    if not text:
        raise ArgumentTypeError('an empty text names no folder.')
    return Path(text)


def replace_file(path: Path, content: bytes) -> None:
    """
    Write a file atomically: it appears complete or not at all.

    Parameters
    ----------
    path
        Path of the file; an existing file is replaced.
    content
        Content of the file.

    Raises
    ------
    SimulationError
        It cannot be written; an existing file is left unchanged.

    """
    new = path.with_name(f'.{path.name}.{os.getpid()}')
    try:
        try:
            new.write_bytes(content)
            new.replace(path)
        finally:
            new.unlink(missing_ok=True)
    except OSError as error:
        raise SimulationError(f'{path} cannot be written: {error.strerror}.') from error


class SceneChoices(list[str]):
    """
    The names of the installed scenes, for completion; paths of scene files are accepted as well.

    It is a list, as `DeclareLaunchArgument` requires of its choices: a wrong name ends the launch
    when the argument is declared, before any process has started.
    """

    def __init__(self) -> None:
        super().__init__(installed_scenes())

    def __contains__(self, value: object) -> bool:
        """Check whether a text is the name of a scene, or the path of a file that can be one."""
        is_path = isinstance(value, str) and value.endswith(SCENE_SUFFIXES)
        return super().__contains__(value) or (is_path and Path(str(value)).is_file())

    def __str__(self) -> str:
        """Format the choices for descriptions and error messages."""
        return ', '.join(f"'{name}'" for name in self) + ', or the path of a file (.yaml)'
