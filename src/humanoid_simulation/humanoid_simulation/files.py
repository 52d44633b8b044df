# SPDX-License-Identifier: Apache-2.0
"""Installed files of this package, and atomic writing of files."""

from __future__ import annotations

import os
from pathlib import Path

from humanoid_simulation.errors import SimulationError

SCENE_SUFFIXES = ('.yaml', '.yml')


def share() -> Path:
    """Return the share directory, with the scenes and the configuration."""
    from ament_index_python.packages import get_package_share_directory

    return Path(get_package_share_directory('humanoid_simulation'))


def installed_scenes() -> dict[str, Path]:
    """Find the files of the installed scenes, by name."""
    return {path.stem: path for path in sorted((share() / 'scenes').glob('*.yaml'))}


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
