# SPDX-License-Identifier: Apache-2.0
"""Parse the initial poses of several robots from a command line argument."""

from __future__ import annotations

import sys
from typing import Any

import yaml

__all__ = ['ParseMultiRobotPose']

_KEYS = ('x', 'y', 'z', 'roll', 'pitch', 'yaw')


class ParseMultiRobotPose:
    """
    Parser of robot poses: `robots:="r1={x: 1.0, y: 2.0, yaw: 1.57}; r2={x: 0.0}"`.

    Parameters
    ----------
    target_argument
        The name of the argument.

    """

    def __init__(self, target_argument: str) -> None:
        start = f'{target_argument}:='
        given = [word.removeprefix(start) for word in sys.argv if word.startswith(start)]
        self.__text = given[-1] if given else ''

    def value(self) -> dict[str, dict[str, float]]:
        """
        Return x, y, z (m), roll, pitch and yaw (rad) of each robot by its name.

        Raises
        ------
        ValueError
            The argument does not have that format.

        """
        robots = {}
        for part in filter(None, (part.strip() for part in self.__text.split(';'))):
            name, _, text = part.partition('=')
            pose = _pose(text)
            if not name.strip() or pose is None:
                raise ValueError(
                    f"'{part}' does not give the initial pose of a robot. Write it as "
                    'name={x: 1.0, y: 2.0, yaw: 1.57}, and a semicolon between two robots.'
                )
            robots[name.strip()] = pose
        return robots


def _pose(text: str) -> dict[str, float] | None:
    try:
        given: Any = yaml.safe_load(text)
        if not isinstance(given, dict) or set(given) - set(_KEYS):
            return None
        return {key: float(given.get(key, 0.0)) for key in _KEYS}
    except (yaml.YAMLError, TypeError, ValueError):
        return None
