# SPDX-License-Identifier: Apache-2.0
"""Types of messages and messages for tests, without ROS."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

FIELDS = {
    'a/State': {
        'header': 'a/Header',
        'name': 'sequence<string>',
        'position': 'sequence<double>',
        'effort': 'sequence<double>',
    },
    'a/Header': {'stamp': 'a/Time', 'frame_id': 'string'},
    'a/Time': {'sec': 'int32', 'nanosec': 'uint32'},
    'a/Imu': {'turn': 'a/Vector', 'covariance': 'double[2]', 'is_on': 'boolean', 'raw': 'octet'},
    'a/Vector': {'x': 'double', 'y': 'double'},
    'a/Transforms': {'transforms': 'sequence<a/Transform>'},
    'a/Transform': {'child_frame_id': 'string', 'at': 'a/Vector'},
    'a/Trajectory': {'joint_names': 'sequence<string>', 'points': 'sequence<a/Point, 9>'},
    'a/Point': {'positions': 'sequence<double>'},
    'a/Text': {'data': 'string<10>'},
}


def schema(type_name: str) -> dict[str, str]:
    """Return the fields of a type."""
    return FIELDS[type_name]


def state(**positions: float) -> Any:
    """Return the state of some joints."""
    header = SimpleNamespace(stamp=SimpleNamespace(sec=7, nanosec=8), frame_id='base')
    names, values = list(positions), list(positions.values())
    return SimpleNamespace(header=header, name=names, position=values, effort=[])


def vector(x: float, y: float) -> Any:
    """Return a vector."""
    return SimpleNamespace(x=x, y=y)


def transforms(**at: float) -> Any:
    """Return transforms of frames along x."""
    return SimpleNamespace(
        transforms=[
            SimpleNamespace(child_frame_id=name, at=vector(x, 0.0)) for name, x in at.items()
        ]
    )
