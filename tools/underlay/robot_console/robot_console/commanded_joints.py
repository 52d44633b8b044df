# SPDX-License-Identifier: Apache-2.0
"""Where the links of a robot were commanded to be, and which of them are there."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass
from math import acos, dist, isfinite

from rviz_common.frames import Pose
from rviz_default_plugins.robot.robot_scene import PoseOf
from urdf import followed, Joint, RobotModel
from urdf.kinematics import joint_motion
from urdf.kinematics import Pose as JointPose

__all__ = ['CommandedJoints', 'Tolerances', 'following_links']

VALID_S = 1.0
CAUGHT_UP = 0.7
"""The share of the tolerances within which a link that lagged behind has caught up."""


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


@dataclass(frozen=True)
class Tolerances:
    """The deviation of a link from its commanded pose from which on it lags behind."""

    position_m: float
    angle_rad: float

    def hold(self, commanded: Pose, measured: Pose, share: float = 1.0) -> bool:
        """
        Check whether two poses in the same frame differ by less than the tolerances.

        Parameters
        ----------
        commanded, measured
            The poses.
        share
            The factor of both tolerances.

        """
        if dist(commanded.position, measured.position) >= share * self.position_m:
            return False
        cosine = abs(sum(one * other for one, other in zip(commanded.wxyz, measured.wxyz)))
        return 2.0 * acos(min(1.0, cosine)) < share * self.angle_rad


def following_links(
    root: str,
    joints: Iterable[Joint],
    poses_of: tuple[PoseOf, PoseOf],
    tolerances: Tolerances,
    before: Container[str] = frozenset(),
) -> frozenset[str]:
    """
    Find the links that are where they were commanded to be, relative to the root link.

    The deviations of all joints between the root and a link add up. A link of which the commanded
    or the measured pose is unknown does not follow.

    Parameters
    ----------
    root
        The name of the root link.
    joints
        The joints, each after its parent joint.
    poses_of
        Two functions that return the pose of the child link of a joint in its parent link, as
        commanded and as measured, None if it is unknown.
    tolerances
        The deviation from which on a link lags behind.
    before
        The links that followed before. Others have to come a little closer, so that a link at the
        limit does not flicker.

    """
    known = {root: (Pose(), Pose())}
    for joint in joints:
        told, measured = (pose_of(joint) for pose_of in poses_of)
        above = known.get(joint.parent)
        if above is not None and told is not None and measured is not None:
            known[joint.child] = above[0].of(told), above[1].of(measured)
    return frozenset(
        link
        for link, poses in known.items()
        if tolerances.hold(*poses, 1.0 if link in before else CAUGHT_UP)
    )
