# SPDX-License-Identifier: Apache-2.0
"""The files that this package installs."""

from __future__ import annotations

from pathlib import Path
from typing import Any


def share() -> Path:
    """Return the share directory of this package, with the model and its configuration."""
    from ament_index_python.packages import get_package_share_directory

    return Path(get_package_share_directory('humanoid_description'))


def load_config(name: str) -> dict[str, Any]:
    """
    Load a YAML file of this package's installed folder config.

    Parameters
    ----------
    name
        The name of the file with its ending, such as `joints.yaml`.

    """
    import yaml

    loaded: dict[str, Any] = yaml.safe_load((share() / 'config' / name).read_text())
    return loaded
