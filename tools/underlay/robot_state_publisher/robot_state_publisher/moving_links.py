# SPDX-License-Identifier: Apache-2.0
"""The poses of the links that a joint state moves, and the positions in it that can be used."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from urdf import followed, Joint, RobotModel
from urdf.kinematics import joint_motion, Pose

__all__ = ['MovingLinks', 'UnusableStateError', 'usable_positions']


class UnusableStateError(ValueError):
    """Raised, with the reason, if a joint state is rejected."""


def usable_positions(
    names: Sequence[str], positions: Sequence[float]
) -> tuple[tuple[str, ...], Sequence[float]]:
    """
    Drop the non-finite positions of a joint state, together with their names.

    Sources publish NaN for unknown positions.

    Parameters
    ----------
    names
        The joints of the message.
    positions
        Their positions, in rad or m.

    Returns
    -------
    tuple
        The remaining names and positions, in the original order.

    Raises
    ------
    UnusableStateError
        The numbers of positions and names differ.

    """
    if len(positions) != len(names):
        raise UnusableStateError(_mismatch(names, positions))
    if isfinite(sum(positions)):
        return tuple(names), positions
    pairs = [(name, value) for name, value in zip(names, positions) if isfinite(value)]
    return tuple(name for name, _ in pairs), [value for _, value in pairs]


def _mismatch(names: Sequence[str], positions: Sequence[float]) -> str:
    about = ', '.join(f"'{name}'" for name in names)
    if not positions:
        return f'A joint state about {about} has no positions, and is ignored.'
    return (
        f'A joint state has {len(names)} names but {len(positions)} positions, and is ignored; '
        f'it is about {about or "no joint"}.'
    )


@dataclass(frozen=True)
class _Drive:
    """Mapping from an index in the list of positions to the position of a joint."""

    joint: Joint
    index: int
    multiplier: float
    offset: float


class MovingLinks:
    """
    Forward kinematics of the joints driven by a list of joint names.

    A mimic joint follows its leader, also through a chain of mimic joints, unless it is itself in
    the list.

    Parameters
    ----------
    model
        The robot.
    names
        The joints whose positions will be given, in that order; unknown names are ignored.

    Attributes
    ----------
    joints
        The driven joints, in the order of the URDF.

    """

    def __init__(self, model: RobotModel, names: Sequence[str]) -> None:
        index_of = {name: index for index, name in enumerate(names)}
        drives = list(_drives(model, index_of))
        self.joints = tuple(drive.joint for drive in drives)
        self._motions = [joint_motion(drive.joint) for drive in drives]
        self._rules = [(drive.index, drive.multiplier, drive.offset) for drive in drives]

    def poses(self, positions: Sequence[float]) -> list[Pose]:
        """
        Compute the pose of the child link of each joint relative to its parent link.

        Parameters
        ----------
        positions
            The joint positions, in the order of the names, in rad or m.

        Returns
        -------
        list of Pose
            For each of `joints`: translation in m, quaternion x, y, z, w.

        Raises
        ------
        UnusableStateError
            The position of a mimic joint would not be finite.

        """
        values = [
            multiplier * positions[index] + offset for index, multiplier, offset in self._rules
        ]
        if not isfinite(sum(values)) and not all(map(isfinite, values)):
            raise UnusableStateError(_beyond(self.joints, values))
        return [pose(value) for pose, value in zip(self._motions, values)]


def _beyond(joints: Sequence[Joint], values: Sequence[float]) -> str:
    """Format an error message that names the joints with non-finite positions."""
    names = [f"'{joint.name}'" for joint, value in zip(joints, values) if not isfinite(value)]
    return (
        f'A joint state is ignored, because the positions of {", ".join(names)} would not be '
        'finite.'
    )


def _drives(model: RobotModel, index_of: dict[str, int]) -> list[_Drive]:
    """Return the drive of each joint that is named or mimics a named joint."""
    mimics = model.mimics
    drives = []
    for joint in model.moving_joints:
        leader = followed(joint.name, mimics, index_of)
        if leader is not None:
            index = index_of[leader.joint]
            drives.append(_Drive(joint, index, leader.multiplier, leader.offset))
    return drives
