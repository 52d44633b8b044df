# SPDX-License-Identifier: Apache-2.0
"""Geometry of a leg that has closed-form inverse kinematics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_common.naming import did_you_mean
from humanoid_control.dynamics.tree import DynamicsError
from humanoid_description.drives import SIDES
from humanoid_description.kinematics import chain, poses
from humanoid_description.robot import Array, Joint, named, Robot
import numpy as np

# The joints from the hip to the foot, and their axes of rotation.
AXES = {
    'hip_yaw': 'z',
    'hip_roll': 'x',
    'hip_pitch': 'y',
    'knee': 'y',
    'ankle_pitch': 'y',
    'ankle_roll': 'x',
}
_SOLES = dict(zip(SIDES, ('l_sole', 'r_sole')))
_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False)
class LegGeometry:
    """
    Geometry of a leg that hangs straight down at zero joint positions.

    The three axes of the hip intersect in one point, the two of the ankle in another; the knee is
    between them. At zero the axes of the sole are parallel to those of the root.
    """

    joints: tuple[str, ...]
    """six names: hip yaw, roll, pitch, knee, ankle pitch, roll"""
    sole: str
    """the link of the sole"""
    hip_m: Array
    """(3,) in the root"""
    thigh_m: float
    shank_m: float
    ankle_m: Array
    """(3,) in the sole"""

    @classmethod
    def of(cls, robot: Robot, side: str) -> LegGeometry:
        """
        Read the geometry of a leg from the description of a robot.

        Parameters
        ----------
        robot
            Its links and joints.
        side
            `left` or `right`.

        Raises
        ------
        DynamicsError
            The side is unknown, or the robot has no such leg, or its kinematics are different.

        """
        sole = _sole(robot, side)
        joints = [joint for joint in chain(robot, sole) if joint.is_driven]
        at_zero = poses(robot)
        _check(robot, side, joints, [at_zero[joint.child] for joint in joints])
        hip, knee, ankle = (at_zero[joints[i].child][:3, 3] for i in (2, 3, 5))
        return cls(
            tuple(joint.name for joint in joints),
            sole,
            hip,
            float(hip[2] - knee[2]),
            float(knee[2] - ankle[2]),
            ankle - at_zero[sole][:3, 3],
        )

    @property
    def length_m(self) -> float:
        """Return the distance from hip to ankle of the stretched leg."""
        return self.thigh_m + self.shank_m


def _sole(robot: Robot, side: str) -> str:
    """Return the name of the sole link of a leg."""
    if side not in _SOLES:
        raise DynamicsError(f"A side must be {' or '.join(SIDES)}, not '{side}'.")
    sole = robot.prefix + _SOLES[side]
    if sole not in robot.link:
        raise DynamicsError(
            f"Robot '{robot.name}' has no {side} leg: there is no link '{sole}'. "
            f'{did_you_mean(sole, robot.link)}'.rstrip()
        )
    return sole


def _check(robot: Robot, side: str, joints: Sequence[Joint], at_zero: Sequence[Array]) -> None:
    """Validate the joints and axes of a leg; poses are at zero joint positions, in the root."""
    needed = [f'{robot.prefix}{side}_{kind}' for kind in AXES]
    found = [joint.name for joint in joints]
    if found != needed:
        raise DynamicsError(
            f'The {side} leg has the joints {", ".join(found) or "(none)"}, but needs '
            f'{", ".join(needed)}, in this order from the hip to the foot.'
        )
    for joint, pose, letter in zip(joints, at_zero, AXES.values()):
        if not np.allclose(pose[:3, :3] @ joint.axis, _unit(letter), atol=_TOLERANCE):
            raise DynamicsError(
                f'{named(joint)} must rotate about {letter} of the root link at the zero pose.'
            )
    _check_places([pose[:3, 3] for pose in at_zero], side)


def _check_places(points: Sequence[Array], side: str) -> None:
    """Reject a leg whose joint axes do not meet as the closed-form solution requires."""
    yaw, roll, hip, knee, pitch, ankle = points
    straight = all(
        np.allclose(lower[:2], upper[:2], atol=_TOLERANCE) and lower[2] < upper[2]
        for upper, lower in ((hip, knee), (knee, ankle))
    )
    meet = all(
        np.allclose(one, other, atol=_TOLERANCE)
        for one, other in ((yaw, hip), (roll, hip), (pitch, ankle))
    )
    if not (straight and meet):
        raise DynamicsError(
            f'The kinematics of the {side} leg are not supported: the three hip axes must '
            'intersect in one point, the two ankle axes in another, with the knee straight '
            'between them.'
        )


def _unit(letter: str) -> Array:
    """Return a unit vector along x, y or z."""
    unit: Array = np.eye(3)['xyz'.index(letter)]
    return unit
