# SPDX-License-Identifier: Apache-2.0
"""The docks that the server knows, from parameters or from a file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from geometry_msgs.msg import PoseStamped
from nav2_util.errors import ConfigurationError
from nav2_util.geometry import planar_pose, Pose2D
import yaml

__all__ = ['Dock', 'find_dock', 'make_dock', 'read_docks']


class Dock(NamedTuple):
    """A dock: its name, its type, and its pose in a frame."""

    name: str
    kind: str
    frame: str
    pose: Pose2D
    id: str = ''
    """A second name."""

    @classmethod
    def of_pose(cls, kind: str, pose: PoseStamped) -> Dock:
        """
        Make a dock without a name.

        Parameters
        ----------
        kind
            The name of its type.
        pose
            Its pose; without a frame, it is in map.

        """
        return cls('', kind, pose.header.frame_id or 'map', planar_pose(pose.pose))


def make_dock(name: str, values: Mapping[str, Any]) -> Dock:
    """
    Make a dock from its description.

    Parameters
    ----------
    name
        The name of the dock.
    values
        `type`, `pose` ([x, y, yaw] in m and rad), and optionally `frame` (by default map) and
        `id`.

    Raises
    ------
    ConfigurationError
        The type is missing, or the pose is not a list of three numbers.

    """
    kind, pose = values.get('type'), values.get('pose')
    if not isinstance(kind, str) or not kind:
        raise ConfigurationError(
            f"The dock '{name}' has no type. Set its 'type' to one of dock_plugins."
        )
    try:
        x, y, yaw = (float(each) for each in pose or ())
    except (TypeError, ValueError) as error:
        raise ConfigurationError(
            f"The pose of the dock '{name}' must be [x, y, yaw], in m and rad, but is {pose!r}."
        ) from error
    frame, second = str(values.get('frame') or 'map'), str(values.get('id') or '')
    return Dock(name, kind, frame, Pose2D(x, y, yaw), second)


def read_docks(path: str) -> list[Dock]:
    """
    Read docks from a YAML file, which describes them by their names below the key `docks`.

    Parameters
    ----------
    path
        The path of the file.

    Raises
    ------
    ConfigurationError
        The file cannot be read, or does not describe docks.

    """
    try:
        data = yaml.safe_load(Path(path).read_text(encoding='utf-8'))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise ConfigurationError(
            f"The file of docks '{path}' cannot be read: {error}. Set the parameter "
            'dock_database to a YAML file.'
        ) from error
    docks = data.get('docks') if isinstance(data, dict) else None
    if not isinstance(docks, dict) or not all(isinstance(each, dict) for each in docks.values()):
        raise ConfigurationError(
            f"The file '{path}' does not describe docks. It must have the key 'docks', and below "
            "it for each name of a dock 'type', 'frame' and 'pose'."
        )
    return [make_dock(str(name), values) for name, values in docks.items()]


def find_dock(docks: Iterable[Dock], name: str) -> Dock | None:
    """
    Find a dock by its name or its `id`.

    Parameters
    ----------
    docks
        The known docks.
    name
        The name, or the `id`.

    Returns
    -------
    Dock or None
        None if there is no such dock.

    """
    return next((dock for dock in docks if name and name in (dock.name, dock.id)), None)
