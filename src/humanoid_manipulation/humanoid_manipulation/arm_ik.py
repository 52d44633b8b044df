# SPDX-License-Identifier: Apache-2.0
"""
Closed-form inverse kinematics of an arm with six joints.

The three axes of the shoulder intersect in one point, so the arm has a closed-form solution by
D. L. Pieper, The Kinematics of Manipulators under Computer Control (1968): the distance from wrist
to shoulder gives the elbow angle, the direction to the shoulder in the frame of the hand gives the
wrist angles, and the remaining rotation gives the shoulder angles. Each of the three steps has two
solutions, so there are up to eight postures for a pose.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import math

from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.kinematics import chain, poses
from humanoid_description.robot import Array, Joint, named, Robot
from humanoid_description.rotations import about_x, about_y, about_z
from humanoid_manipulation.errors import ManipulationError
import numpy as np

__all__ = ['Arm', 'Posture']

Posture = tuple[float, ...]
"""The positions of the six joints of an arm (rad), from the shoulder down."""

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
_STRETCHED_M = 1e-7
"""A shoulder within this distance of the forearm's line counts as on it: see `near`."""
_COINCIDING = 1e-9
"""Cosine of the roll below which pitch and yaw share one axis: a singularity."""


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

    @property
    def reach_m(self) -> float:
        """Return the largest distance of the wrist pitch joint from the shoulder."""
        return self.upper_m + self.fore_m

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
        wx, wy, wz = self._to_shoulder_m(gripper)
        upper, fore = self.upper_m, self.fore_m
        given = near or (0.0,) * _COUNT
        for elbow in _elbows(upper, fore, math.sqrt(wx * wx + wy * wy + wz * wz)):
            back, up = -upper * math.sin(elbow), fore + upper * math.cos(elbow)
            for wrist_yaw in _wrist_yaws(back, wy, given[4]):
                ahead = back * math.cos(wrist_yaw)
                wrist_pitch = math.atan2(wz, wx) - math.atan2(up, ahead)
                below = elbow, wrist_yaw, wrist_pitch
                for pitch, roll, yaw in _shoulders(rotation, below, given[0]):
                    yield (
                        pitch,
                        roll,
                        math.remainder(yaw, math.tau),
                        elbow,
                        math.remainder(wrist_yaw, math.tau),
                        math.remainder(wrist_pitch, math.tau),
                    )

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
        wx, wy, wz = self._to_shoulder_m(gripper)
        distance_m = math.sqrt(wx * wx + wy * wy + wz * wz)
        nearest_m = min(max(distance_m, abs(self.upper_m - self.fore_m)), self.reach_m)
        (elbow, *_) = _elbows(self.upper_m, self.fore_m, nearest_m)
        beside_m = max(abs(wy) - abs(self.upper_m * math.sin(elbow)), 0.0)
        return abs(distance_m - nearest_m) + beside_m

    def _to_shoulder_m(self, gripper: Frame) -> tuple[float, float, float]:
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


def _elbows(upper_m: float, fore_m: float, distance_m: float) -> tuple[float, ...]:
    """Return the elbow angles that bring wrist and shoulder to a distance."""
    # Half angles: accurate for a nearly stretched arm, where the cosine is not.
    shorter = (upper_m + fore_m - distance_m) * (upper_m + fore_m + distance_m)
    longer = (distance_m - upper_m + fore_m) * (distance_m + upper_m - fore_m)
    if not min(shorter, longer) >= -_TOLERANCE:
        return ()
    turn = 2.0 * math.atan2(math.sqrt(max(shorter, 0.0)), math.sqrt(max(longer, 0.0)))
    return (turn, -turn) if turn else (turn,)


def _wrist_yaws(back: float, across: float, given: float) -> tuple[float, ...]:
    """Return the wrist yaw angles that give the shoulder's offset across the hand."""
    if abs(across) > abs(back) + _STRETCHED_M:
        return ()
    if abs(back) <= _STRETCHED_M:
        return (given,)
    turn = math.asin(max(-1.0, min(1.0, -across / back)))
    return turn, math.pi - turn


def _shoulders(
    rotation: Sequence[Sequence[float]], below: tuple[float, float, float], given: float
) -> Iterator[tuple[float, float, float]]:
    """Yield the pitch, roll and yaw of the shoulder that give the hand its rotation."""
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = rotation
    elbow, wrist_yaw, wrist_pitch = below
    # The rotation of the upper arm is that of the hand, with the joints below undone.
    c6, s6 = math.cos(wrist_pitch), math.sin(wrist_pitch)
    c5, s5 = math.cos(wrist_yaw), math.sin(wrist_yaw)
    c4, s4 = math.cos(elbow), math.sin(elbow)
    # Its columns: those of Ry(-wrist_pitch) Rz(-wrist_yaw) Ry(-elbow).
    m00, m01, m02 = c6 * c5 * c4 - s6 * s4, c6 * s5, -c6 * c5 * s4 - s6 * c4
    m10, m11, m12 = -s5 * c4, c5, s5 * s4
    m20, m21, m22 = s6 * c5 * c4 + c6 * s4, s6 * s5, -s6 * c5 * s4 + c6 * c4
    u02 = r00 * m02 + r01 * m12 + r02 * m22
    u10 = r10 * m00 + r11 * m10 + r12 * m20
    u11 = r10 * m01 + r11 * m11 + r12 * m21
    u12 = r10 * m02 + r11 * m12 + r12 * m22
    u22 = r20 * m02 + r21 * m12 + r22 * m22
    level = math.hypot(u02, u22)
    for cosine_roll in (level, -level):
        roll = math.atan2(-u12, cosine_roll)
        if level > _COINCIDING:
            pitch = math.atan2(u02 / cosine_roll, u22 / cosine_roll)
            yaw = math.atan2(u10 / cosine_roll, u11 / cosine_roll)
        else:
            u00 = r00 * m00 + r01 * m10 + r02 * m20
            u01 = r00 * m01 + r01 * m11 + r02 * m21
            pitch = given
            yaw = math.copysign(1.0, -u12) * pitch + math.atan2(-u01, u00)
        yield pitch, roll, yaw


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
    needed = [f'{robot.prefix}{side}_{kind}' for kind in AXES]
    found = [joint.name for joint in joints]
    if found != needed:
        raise ManipulationError(
            f'The {side} arm has the joints {", ".join(found) or "(none)"}, but needs '
            f'{", ".join(needed)}. Start the robot with hands: hands:=true'
        )
    for joint, pose, letter in zip(joints, at_zero, AXES.values()):
        unit = np.eye(3)['xyz'.index(letter)]
        if not np.allclose(pose[:3, :3] @ joint.axis, unit, atol=_TOLERANCE):
            raise ManipulationError(
                f'{named(joint)} must rotate about {letter} of the root link at the zero pose.'
            )
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
