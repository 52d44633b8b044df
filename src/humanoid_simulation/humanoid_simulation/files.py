# SPDX-License-Identifier: Apache-2.0
"""The files that this package installs."""

from __future__ import annotations

from pathlib import Path

SCENE_SUFFIXES = ('.yaml', '.yml')


def share() -> Path:
    """Return the folder with the scenes and the configuration."""
    from ament_index_python.packages import get_package_share_directory

    return Path(get_package_share_directory('humanoid_simulation'))


def installed_scenes() -> dict[str, Path]:
    """Return the files of the scenes that are installed, by name."""
    return {path.stem: path for path in sorted((share() / 'scenes').glob('*.yaml'))}
