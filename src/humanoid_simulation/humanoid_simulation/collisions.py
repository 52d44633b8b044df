# SPDX-License-Identifier: Apache-2.0
"""
Collision filtering with `contype` and `conaffinity`.

Two geoms collide when a bit of the `contype` of one is set in the `conaffinity` of the other.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

WORLD = 1
_ARM_ON_ARM = 1 << 1
_ARM_ON_TRUNK = 1 << 2
_LEG_ON_LEG = 1 << 3
_FIRST_ROBOT = 8
MOST_ROBOTS = 20
_ALL_ROBOTS = ((1 << MOST_ROBOTS) - 1) << _FIRST_ROBOT

_ARMS = ('upper_arm', 'forearm', 'palm', 'finger', 'thumb')
_TRUNK = ('base_link', 'torso', 'head', 'left_thigh', 'right_thigh')
_LEGS = ('thigh', 'shank', 'foot')

COLLISION_GROUP = 3
"""The group of the geoms that collide but are not rendered."""


@dataclass(frozen=True)
class Bits:
    """Collision bits of a geom, as MuJoCo defines them."""

    contype: int
    conaffinity: int

    def __or__(self, other: Bits) -> Bits:
        """Combine the collision bits of both."""
        return Bits(self.contype | other.contype, self.conaffinity | other.conaffinity)


NOTHING = Bits(0, 0)


def is_collision(geom: Any) -> bool:
    """
    Check whether a geom of a robot came from a collision element of its URDF.

    Parameters
    ----------
    geom
        A geom of a MuJoCo specification, as it was read from a URDF.

    """
    return bool(geom.contype or geom.conaffinity)


def robot_bits(link: str, number: int, self_collision: str) -> Bits:
    """
    Compute the collision bits of a link of a robot.

    Links always collide with the world and with other robots.

    Parameters
    ----------
    link
        Name of the link, without the prefix of the robot.
    number
        Index of the robot, from 0 to `MOST_ROBOTS` - 1.
    self_collision
        A key of `SELF_COLLISIONS`: which links of the robot collide with each other.

    Returns
    -------
    Bits
        For the collision geoms of the link.

    """
    own = 1 << (_FIRST_ROBOT + number)
    bits = Bits(own, WORLD | (_ALL_ROBOTS & ~own))
    if self_collision in ('arms', 'all'):
        bits |= _arm_bits(link)
    if self_collision == 'all':
        bits |= _leg_bits(link)
    return bits


def _arm_bits(link: str) -> Bits:
    """Compute the bits for collisions of arms with each other, the trunk and the thighs."""
    if link.endswith(_ARMS):
        return Bits(_ARM_ON_ARM | _ARM_ON_TRUNK, _ARM_ON_ARM)
    return Bits(0, _ARM_ON_TRUNK) if link in _TRUNK else NOTHING


def _leg_bits(link: str) -> Bits:
    """Compute the bits for collisions of the left leg with the right one."""
    if not link.endswith(_LEGS):
        return NOTHING
    return Bits(_LEG_ON_LEG, 0) if link.startswith('left') else Bits(0, _LEG_ON_LEG)
