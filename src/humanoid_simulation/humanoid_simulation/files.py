# SPDX-License-Identifier: Apache-2.0
"""The files that this package installs, and how it writes others."""

from __future__ import annotations

import os
from pathlib import Path

from humanoid_simulation.errors import SimulationError

SCENE_SUFFIXES = ('.yaml', '.yml')


def share() -> Path:
    """Return the folder with the scenes and the configuration."""
    from ament_index_python.packages import get_package_share_directory

    return Path(get_package_share_directory('humanoid_simulation'))


def installed_scenes() -> dict[str, Path]:
    """Return the files of the scenes that are installed, by name."""
    return {path.stem: path for path in sorted((share() / 'scenes').glob('*.yaml'))}


def replace_file(path: Path, content: bytes) -> None:
    """
    Write a file that appears complete or not at all.

    Parameters
    ----------
    path
        The file; one that is there is replaced.
    content
        What it is to contain.

    Raises
    ------
    SimulationError
        It cannot be written; a file that was there stays as it was.

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
