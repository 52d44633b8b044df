# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics of the commanded joint positions."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from rviz_common.frames import Pose
from urdf import followed, RobotModel
from urdf.kinematics import joint_motion
from urdf.kinematics import Pose as JointPose

__all__ = ['CommandedJoints']

VALID_S = 1.0


class CommandedJoints:
    """
    The joint positions commanded in the last second, and the link poses that result from them.

    Each command may contain only some of the joints.

    Parameters
    ----------
    model
        The robot.

    Attributes
    ----------
    unknown
        The joints of the last command that the robot does not have, sorted.

    """

    def __init__(self, model: RobotModel) -> None:
        self.model = model
        self._mimics = model.mimics
        self._motions = {joint.name: joint_motion(joint) for joint in model.moving_joints}
        self._fixed = {
            joint.name: _pose(joint_motion(joint)(0.0))
            for joint in model.joints
            if joint.kind == 'fixed'
        }
        self._told: dict[str, tuple[float, float]] = {}
        self.unknown: list[str] = []

    def take(self, names: Sequence[str], positions: Sequence[float], now_s: float) -> None:
        """
        Store a command; non-finite positions are ignored.

        Parameters
        ----------
        names, positions
            The joints and their commanded positions, in rad or m.
        now_s
            The time of reception, from `time.time`.

        Raises
        ------
        ValueError
            The numbers of positions and names differ; the message completes a sentence.

        """
        if len(positions) != len(names):
            raise ValueError(f'it has {len(names)} names but {len(positions)} positions.')
        for name, position in zip(names, positions):
            if isfinite(position) and name in self._motions:
                self._told[name] = float(position), now_s
        self.unknown = sorted(set(names).difference(self._motions))

    def is_told(self, now_s: float) -> bool:
        """
        Check whether a joint was commanded in the last second.

        Parameters
        ----------
        now_s
            The current time, from `time.time`.

        """
        return any(now_s - at_s < VALID_S for _, at_s in self._told.values())

    def poses(self, now_s: float) -> dict[str, Pose]:
        """
        Compute the commanded forward kinematics, joint by joint.

        Mimic joints follow their leaders. Fixed joints are included while any joint is commanded.

        Parameters
        ----------
        now_s
            The current time, from `time.time`; commands older than a second are ignored.

        Returns
        -------
        dict
            The pose of the child link of each joint, by joint name, in the frame of the parent
            link: translation in m, quaternion w, x, y, z. Joints without a command are missing.

        """
        told = {
            name: position
            for name, (position, at_s) in self._told.items()
            if now_s - at_s < VALID_S
        }
        if not told:
            return {}
        poses = dict(self._fixed)
        for name, motion in self._motions.items():
            leader = followed(name, self._mimics, told)
            if leader is not None:
                poses[name] = _pose(motion(leader.multiplier * told[leader.joint] + leader.offset))
        return poses


def _pose(pose: JointPose) -> Pose:
    """Convert a pose to the quaternion order of the page: w, x, y, z."""
    x, y, z, qx, qy, qz, qw = pose
    return Pose((x, y, z), (qw, qx, qy, qz))
