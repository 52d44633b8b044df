# SPDX-License-Identifier: Apache-2.0
"""Keyframes: named postures."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from humanoid_common.tables import load_table, Table
from humanoid_control.backends import Array
from humanoid_simulation.errors import named
from humanoid_simulation.files import share
import numpy as np

SIDES = {'left_': 1.0, 'right_': -1.0}


@dataclass(frozen=True)
class Keyframe:
    """Joint positions by names without a prefix, zero by default, and the tilt of the base."""

    joints_rad: Mapping[str, float] = field(default_factory=dict)
    roll_rad: float = 0.0
    pitch_rad: float = 0.0

    def positions_rad(self, joints: Iterable[str], prefix: str = '') -> Array:
        """
        Arrange the joint positions of the keyframe in a given order of joints.

        Parameters
        ----------
        joints
            Names of the n joints, in the order of the result.
        prefix
            Prefix of these names, which those of the keyframe lack.

        Returns
        -------
        Array
            Positions (n,) in rad, or m for a prismatic joint; zero if the keyframe sets none.

        Raises
        ------
        SimulationError
            The keyframe sets a joint that is not among them.

        """
        numbers = {joint.removeprefix(prefix): index for index, joint in enumerate(joints)}
        positions = np.zeros(len(numbers))
        for name, position in self.joints_rad.items():
            positions[named('joint', name, numbers)] = position
        return positions


def load_keyframes() -> dict[str, Keyframe]:
    """Load the installed keyframes, by name."""
    table = load_table(share() / 'config' / 'keyframes.yaml')
    return {name: _keyframe(table.table(name)) for name in table.names}


def _keyframe(table: Table) -> Keyframe:
    """Read one keyframe."""
    table.allow('joints', 'roll', 'pitch')
    joints = table.table('joints')
    return Keyframe(
        _both_sides({name: joints.number(name) for name in joints.names}),
        table.number('roll', 0.0),
        table.number('pitch', 0.0),
    )


def _both_sides(joints_rad: Mapping[str, float]) -> dict[str, float]:
    """Expand joints that are named without a side to both sides, mirrored."""
    result: dict[str, float] = {}
    for name, position in joints_rad.items():
        if name.startswith((*SIDES, 'waist_', 'head_')):
            result[name] = position
        else:
            turned = name.endswith(('_roll', '_yaw'))
            for side, sign in SIDES.items():
                result[side + name] = position * (sign if turned else 1.0)
    return result
