# SPDX-License-Identifier: Apache-2.0
"""Which postures of an arm reach a pose of its gripper: its geometry, limits and kinematics."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.errors import DescriptionError
from humanoid_description.kinematics import chain, check_limb, poses
from humanoid_description.robot import Array, Joint, named, Robot
from humanoid_description.rotations import about_x, about_y, about_z
from humanoid_manipulation.closed_form import lack_m, Posture, solutions, Vector
from humanoid_manipulation.errors import ManipulationError
import numpy as np

AXES = {
    'shoulder': 'y',
    'shoulder_roll': 'x',
    'shoulder_yaw': 'z',
    'elbow': 'y',
    'wrist_yaw': 'z',
    'wrist_pitch': 'y',
}
"""The joints from the shoulder to the hand, and their axes."""

_COUNT = len(AXES)
_GRIPPERS = dict(zip(SIDES, ('l_gripper', 'r_gripper')))
_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False)
class Arm:
    """
    An arm with a hand, which hangs straight down at zero joint positions.

    Attributes
    ----------
    joints
        The names of its six joints, from the shoulder down.
    base, gripper
        The parent link of the shoulder, and the link between the fingers.
    shoulder_m
        The intersection of the shoulder axes (3,), in the base.
    upper_m, fore_m, hand_m
        The lengths from there to the elbow, on to the wrist pitch joint, and on to the centre of
        the grip.
    lower_rad, upper_rad
        The limits of the joints (6,).

    """

    joints: tuple[str, ...]
    base: str
    gripper: str
    shoulder_m: Array
    upper_m: float
    fore_m: float
    hand_m: float
    lower_rad: Posture
    upper_rad: Posture

    @classmethod
    def of(cls, robot: Robot, side: str) -> Arm:
        """
        Extract the left or right arm of a robot.

        Parameters
        ----------
        robot
            The description of a robot with hands.
        side
            `left` or `right`.

        Raises
        ------
        ManipulationError
            The robot has no such arm, or its kinematics differ.

        """
        gripper = _gripper(robot, side)
        joints = [joint for joint in chain(robot, gripper) if joint.is_driven][-_COUNT:]
        at_zero = poses(robot)
        frames = [at_zero[joint.child] for joint in joints]
        _check(robot, side, joints, frames)
        base = joints[0].parent
        to_base = np.linalg.inv(at_zero[base])
        elbow, wrist = frames[3][:3, 3], frames[5][:3, 3]
        shoulder = np.array([*frames[1][:2, 3], frames[0][2, 3]])
        tip = at_zero[gripper][:3, 3]
        limits = [(joint.limits.lower, joint.limits.upper) for joint in joints if joint.limits]
        return cls(
            tuple(joint.name for joint in joints),
            base,
            gripper,
            to_base[:3, :3] @ shoulder + to_base[:3, 3],
            float(shoulder[2] - elbow[2]),
            float(elbow[2] - wrist[2]),
            float(wrist[2] - tip[2]),
            tuple(lower for lower, _ in limits),
            tuple(upper for _, upper in limits),
        )

    def forward(self, posture: Sequence[float]) -> Frame:
        """
        Compute the forward kinematics: the pose of the gripper.

        Parameters
        ----------
        posture
            The positions of the six joints (rad), from the shoulder down.

        Returns
        -------
        Frame
            The pose of the gripper in `base`, the link of the shoulder.

        """
        q1, q2, q3, q4, q5, q6 = posture
        upper = about_y(q1) @ about_x(q2) @ about_z(q3)
        fore = upper @ about_y(q4)
        hand = fore @ about_z(q5) @ about_y(q6)
        position = self.shoulder_m - self.upper_m * upper[:, 2]
        position = position - self.fore_m * fore[:, 2] - self.hand_m * hand[:, 2]
        return Frame(position, hand)

    def points(self, posture: Sequence[float]) -> Array:
        """
        Compute the positions of shoulder, elbow, wrist and gripper.

        Parameters
        ----------
        posture
            The positions of the six joints (rad), from the shoulder down.

        Returns
        -------
        Array
            The four positions (4, 3) in m, in `base`.

        """
        q1, q2, q3, q4 = posture[:4]
        upper = about_y(q1) @ about_x(q2) @ about_z(q3)
        elbow = self.shoulder_m - self.upper_m * upper[:, 2]
        wrist = elbow - self.fore_m * (upper @ about_y(q4))[:, 2]
        return np.stack((self.shoulder_m, elbow, wrist, self.forward(posture).position_m))

    def is_within_limits(self, posture: Sequence[float], margin_rad: float = 0.0) -> bool:
        """
        Check whether all joints are within their limits.

        Parameters
        ----------
        posture
            The positions of the six joints (rad), from the shoulder down.
        margin_rad
            The margin that each joint must keep from its limits.

        """
        return self.excess_rad(posture) <= -margin_rad

    def excess_rad(self, posture: Sequence[float]) -> float:
        """
        Compute by how much the worst joint exceeds its limits.

        Parameters
        ----------
        posture
            The positions of the six joints (rad), from the shoulder down.

        Returns
        -------
        float
            The excess in rad; negative if all joints are within their limits.

        """
        return max(
            max(lower - at, at - upper)
            for at, lower, upper in zip(posture, self.lower_rad, self.upper_rad)
        )

    def postures(self, gripper: Frame, near: Sequence[float] | None = None) -> list[Posture]:
        """
        Solve the inverse kinematics within the joint limits, the best posture first.

        Parameters
        ----------
        gripper
            The target pose of the gripper in the base.
        near
            The current posture; the best posture is the nearest to it in joint space. Without it,
            the best posture is the one farthest from the joint limits.

        Returns
        -------
        list of Posture
            The postures within the limits; none if the pose is out of reach.

        """
        found = [each for each in self.solutions(gripper, near) if self.is_within_limits(each)]
        if near is None:
            return sorted(found, key=self.excess_rad)
        return sorted(found, key=lambda posture: math.dist(posture, near))

    def solutions(self, gripper: Frame, near: Sequence[float] | None = None) -> Iterator[Posture]:
        """
        Yield all solutions of the inverse kinematics, ignoring the joint limits.

        Parameters
        ----------
        gripper
            The target pose of the gripper in the base.
        near
            The posture that supplies the free joint at a singularity; zero by default.

        """
        rotation: list[list[float]] = gripper.rotation.tolist()
        to_shoulder_m = self._to_shoulder_m(gripper)
        yield from solutions(self.upper_m, self.fore_m, to_shoulder_m, rotation, near)

    def lack_m(self, gripper: Frame) -> float:
        """
        Compute by how far a pose misses the workspace of the arm, ignoring the joint limits.

        Parameters
        ----------
        gripper
            The target pose of the gripper in the base.

        Returns
        -------
        float
            By how much the wrist is too far from the shoulder or too near to it, or the shoulder
            is too far off the plane in which the hand bends, in m; 0 if a solution exists.

        """
        return lack_m(self.upper_m, self.fore_m, self._to_shoulder_m(gripper))

    def _to_shoulder_m(self, gripper: Frame) -> Vector:
        """Compute the vector from the wrist to the shoulder, in the axes of the hand."""
        (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = gripper.rotation.tolist()
        px, py, pz = gripper.position_m.tolist()
        sx, sy, sz = self.shoulder_m.tolist()
        hand = self.hand_m
        x, y, z = sx - px - hand * r02, sy - py - hand * r12, sz - pz - hand * r22
        return (
            r00 * x + r10 * y + r20 * z,
            r01 * x + r11 * y + r21 * z,
            r02 * x + r12 * y + r22 * z,
        )


def _gripper(robot: Robot, side: str) -> str:
    """Return the name of the link between the fingers of a hand."""
    if side not in _GRIPPERS:
        raise ManipulationError(f"A side must be {' or '.join(SIDES)}, not '{side}'.")
    gripper = robot.prefix + _GRIPPERS[side]
    if gripper not in robot.link:
        raise ManipulationError(f"Robot '{robot.name}' has no {side} arm: no link '{gripper}'.")
    return gripper


def _check(robot: Robot, side: str, joints: Sequence[Joint], at_zero: Sequence[Array]) -> None:
    """Validate the kinematics of an arm, from the joint poses at zero, in the root link."""
    axes = {f'{robot.prefix}{side}_{kind}': axis for kind, axis in AXES.items()}
    try:
        check_limb(f'{side} arm', joints, at_zero, axes)
    except DescriptionError as error:
        has_all = [joint.name for joint in joints] == [*axes]
        hint = '' if has_all else ' Start the robot with hands: hands:=true'
        raise ManipulationError(f'{error}{hint}') from error
    for joint in joints:
        if joint.limits is None:
            raise ManipulationError(f'{named(joint)} needs joint limits.')
    pitch, roll, yaw, elbow, wrist_yaw, wrist_pitch = (pose[:3, 3] for pose in at_zero)
    meets = pitch[[0, 2]] - roll[[0, 2]], roll[:2] - yaw[:2]
    below = yaw[:2] - elbow[:2], elbow[:2] - wrist_yaw[:2], wrist_yaw[:2] - wrist_pitch[:2]
    if not np.allclose(np.concatenate((*meets, *below)), 0.0, atol=_TOLERANCE):
        raise ManipulationError(
            f'The kinematics of the {side} arm are not supported: the three shoulder axes must '
            'intersect in one point, with the elbow and the wrist straight below it.'
        )
