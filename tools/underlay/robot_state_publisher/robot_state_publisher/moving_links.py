# SPDX-License-Identifier: Apache-2.0
"""The links that a list of joint positions moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite

from robot_state_publisher.joint_positions import UnusableStateError
from urdf import followed, Joint, RobotModel
from urdf.kinematics import joint_motion, Pose

__all__ = ['MovingLinks']


@dataclass(frozen=True)
class _Drive:
    """Where in the list the position of a joint is, and what to make of it."""

    joint: Joint
    index: int
    multiplier: float
    offset: float


class MovingLinks:
    """
    Forward kinematics of each joint that a list of joint names drives.

    A joint that mimics another one follows it, through any number of joints, unless it is itself
    in the list.

    Parameters
    ----------
    model
        The robot.
    names
        The joints whose positions will be given, in that order; unknown ones drive nothing.

    Attributes
    ----------
    joints
        The joints that they drive, in the order of the URDF.

    """

    def __init__(self, model: RobotModel, names: Sequence[str]) -> None:
        index_of = {name: index for index, name in enumerate(names)}
        drives = list(_drives(model, index_of))
        self.joints = tuple(drive.joint for drive in drives)
        self._motions = [joint_motion(drive.joint) for drive in drives]
        self._rules = [(drive.index, drive.multiplier, drive.offset) for drive in drives]

    def poses(self, positions: Sequence[float]) -> list[Pose]:
        """
        Compute the pose of the child link of each joint in its parent link.

        Parameters
        ----------
        positions
            The positions of the names, in their order, in rad or m.

        Returns
        -------
        list of Pose
            For each of `joints`: translation in m, quaternion x, y, z, w.

        Raises
        ------
        UnusableStateError
            A mimic joint would be at a position that is not finite.

        """
        values = [
            multiplier * positions[index] + offset for index, multiplier, offset in self._rules
        ]
        if not isfinite(sum(values)) and not all(map(isfinite, values)):
            raise UnusableStateError(_beyond(self.joints, values))
        return [pose(value) for pose, value in zip(self._motions, values)]


def _beyond(joints: Sequence[Joint], values: Sequence[float]) -> str:
    """Say which joints would be beyond all numbers."""
    names = [f"'{joint.name}'" for joint, value in zip(joints, values) if not isfinite(value)]
    return (
        f'A joint state is left out, as it leads to positions of {", ".join(names)} that are '
        'larger than any number.'
    )


def _drives(model: RobotModel, index_of: dict[str, int]) -> list[_Drive]:
    """Return what drives each joint that is named or follows one that is."""
    mimics = model.mimics
    drives = []
    for joint in model.moving_joints:
        leader = followed(joint.name, mimics, index_of)
        if leader is not None:
            index = index_of[leader.joint]
            drives.append(_Drive(joint, index, leader.multiplier, leader.offset))
    return drives
