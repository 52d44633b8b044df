# SPDX-License-Identifier: Apache-2.0
"""The files that this package installs."""

from __future__ import annotations

from pathlib import Path


def share() -> Path:
    """Return the folder with the scenes and the configuration."""
    from ament_index_python.packages import get_package_share_directory

    return Path(get_package_share_directory('humanoid_simulation'))
