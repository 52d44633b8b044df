# SPDX-License-Identifier: Apache-2.0
"""The installed files of the humanoid: its tables, and its URDF, which xacro expands."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
import subprocess
import sys
from typing import Any

from humanoid_description.errors import DescriptionError


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


def humanoid_urdf(
    scale: float = 1.0,
    prefix: str = '',
    upper_body_only: bool = False,
    hands: bool = False,
    colours: str = 'light',
) -> str:
    """
    Generate the URDF of the humanoid.

    Parameters
    ----------
    scale, prefix, upper_body_only, hands, colours
        The xacro arguments of the model.

    Raises
    ------
    DescriptionError
        xacro is missing, or rejects an argument.

    """
    return expand(
        share() / 'urdf' / 'humanoid.urdf.xacro',
        {
            'scale': repr(scale),
            'prefix': prefix,
            'upper_body_only': str(upper_body_only).lower(),
            'hands': str(hands).lower(),
            'colours': colours,
        },
    )


def expand(path: Path, arguments: Mapping[str, str]) -> str:
    """
    Run xacro on a file, and return the URDF.

    Parameters
    ----------
    path
        The xacro file.
    arguments : Mapping[str, str]
        The values of its xacro arguments by their names.

    Raises
    ------
    DescriptionError
        xacro is missing, or cannot expand the file.

    """
    given = [f'{name}:={value}' for name, value in arguments.items()]
    try:
        result = subprocess.run(
            ['xacro', str(path), *given],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding='utf-8',
        )
    except FileNotFoundError as error:
        raise DescriptionError(
            f"{path} cannot be expanded: the program 'xacro' is not on PATH. Source the ROS 2 "
            'setup file.'
        ) from error
    if result.returncode != 0:
        raise DescriptionError(f'xacro cannot expand {path}:\n{result.stderr.strip()}')
    sys.stderr.write(result.stderr)
    return result.stdout
