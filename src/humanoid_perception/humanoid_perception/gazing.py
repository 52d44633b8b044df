# SPDX-License-Identifier: Apache-2.0
"""Kinematics of the neck: joint angles that point a frame of the head, such as a camera."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
import math
from xml.etree import ElementTree

from humanoid_common.errors import UserError
from humanoid_description.rotations import about_axis, from_rpy
import numpy as np
import numpy.typing as npt

__all__ = ['Aim', 'HeadChain', 'HeadError', 'HeadJoint']

Array = npt.NDArray[np.float64]
_STEP = 1e-5
_ROUNDS = 25
_GOOD_RAD = 1e-3


class HeadError(UserError):
    """The robot description has no usable neck; the message states why."""


@dataclass(frozen=True)
class HeadJoint:
    """A revolute joint: its origin in the parent link, its axis, and its limits."""

    name: str
    parent: str
    child: str
    origin: Array
    """Pose (4, 4) in the parent link, at angle zero."""
    axis: Array
    """Unit vector (3,)."""
    lower_rad: float
    upper_rad: float
    velocity_rad_s: float


@dataclass(frozen=True)
class Aim:
    """Joint angles, and their pointing error."""

    angles_rad: Array
    error_rad: float


class HeadChain:
    """
    Kinematic chain of the neck.

    Parameters
    ----------
    joints
        The joints, from the body to the head.

    """

    def __init__(self, joints: Sequence[HeadJoint]) -> None:
        self.joints = tuple(joints)
        self.lower_rad = np.array([joint.lower_rad for joint in joints])
        self.upper_rad = np.array([joint.upper_rad for joint in joints])
        self.velocity_rad_s = np.array([joint.velocity_rad_s for joint in joints])

    @classmethod
    def of(cls, description: str, names: Sequence[str]) -> HeadChain:
        """
        Read the joints of the neck from a robot description.

        Parameters
        ----------
        description
            The URDF, as on the topic `robot_description`.
        names
            The names of the joints, from the body to the head, which must form one chain.

        Raises
        ------
        HeadError
            The URDF is invalid or lacks a joint, or the joints are not revolute, with limits, in
            one chain.

        """
        try:
            root = ElementTree.fromstring(description)
        except ElementTree.ParseError as error:
            raise HeadError(f'The robot description cannot be read: {error}.') from error
        elements = {each.get('name', ''): each for each in root.findall('joint')}
        missing = [name for name in names if name not in elements]
        if missing or not names:
            raise HeadError(
                f'The robot has no joint {", ".join(missing)}. List its neck joints in the '
                'parameter joints.'
            )
        joints = [_joint(elements[name]) for name in names]
        for before, after in zip(joints, joints[1:]):
            if before.child != after.parent:
                raise HeadError(
                    f"Joint '{after.name}' is not attached to the link of '{before.name}'. "
                    'List the neck joints from the body to the head.'
                )
        return cls(joints)

    @property
    def base_frame(self) -> str:
        """Return the link of the body that carries the neck."""
        return self.joints[0].parent

    @property
    def tip_frame(self) -> str:
        """Return the link that the last joint moves."""
        return self.joints[-1].child

    def pose(self, angles_rad: Sequence[float] | Array) -> Array:
        """
        Compute the forward kinematics of the neck.

        Parameters
        ----------
        angles_rad
            The joint angles (n,), from the body to the head.

        Returns
        -------
        Array
            The pose (4, 4) of the last link in the base frame.

        """
        pose = np.eye(4)
        for joint, angle in zip(self.joints, angles_rad, strict=True):
            turn = np.eye(4)
            turn[:3, :3] = about_axis(joint.axis, float(angle))
            pose = pose @ joint.origin @ turn
        return pose

    def clamp(self, angles_rad: Sequence[float] | Array) -> Array:
        """
        Clamp joint angles to their limits.

        Parameters
        ----------
        angles_rad
            The joint angles (n,), from the body to the head.

        """
        return np.asarray(np.clip(angles_rad, self.lower_rad, self.upper_rad))

    def angle_of(self, number: int, rotation: Array) -> float:
        """
        Compute the angle in rad of a joint from the rotation of its child link in its parent link.

        Parameters
        ----------
        number
            The index of the joint: 0 is the first one, on the body.
        rotation
            The rotation matrix (3, 3), as in the transforms.

        """
        joint = self.joints[number]
        turn = joint.origin[:3, :3].T @ rotation
        skew = np.array(
            [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
        )
        return math.atan2(float(skew @ joint.axis) / 2.0, (float(np.trace(turn)) - 1.0) / 2.0)

    def error_rad(self, angles_rad: Array, target_m: Array, tip: Array, axis: Array) -> float:
        """
        Compute the pointing error: the angle between an axis on the head and the ray to a target.

        Parameters
        ----------
        angles_rad
            The joint angles (n,).
        target_m
            The target (3,), in the base frame.
        tip
            The pose (4, 4) of the pointing frame in the last link.
        axis
            The pointing axis (3,) in that frame, of any length.

        Returns
        -------
        float
            The angle in rad, from 0 to pi.

        """
        along, aside = self._aside(angles_rad, target_m, tip, axis)
        return math.atan2(float(np.linalg.norm(aside)), along)

    def aim(
        self,
        target_m: Array,
        tip: Array,
        axis: Array,
        start_rad: Sequence[float] | Array,
    ) -> Aim:
        """
        Solve the inverse kinematics: the joint angles within the limits with the least error.

        Parameters
        ----------
        target_m
            The target (3,), in the base frame.
        tip
            The pose (4, 4) of the pointing frame in the last link.
        axis
            The pointing axis (3,) in that frame.
        start_rad
            The current joint angles (n,).

        Returns
        -------
        Aim
            The best angles, and the pointing error that remains if the target is out of reach.

        Notes
        -----
        Damped Gauss-Newton on the direction to the target, from several starting points until one
        converges.

        """
        middle = 0.5 * (self.lower_rad + self.upper_rad)
        quarter = 0.25 * (self.upper_rad - self.lower_rad)
        starts = [self.clamp(start_rad), middle]
        for sign in (-1.0, 1.0):
            for number in range(len(self.joints)):
                offset = np.zeros(len(self.joints))
                offset[number] = sign * 1.9 * quarter[number]
                starts.append(self.clamp(middle + offset))
        axis = axis / np.linalg.norm(axis)
        best = Aim(starts[0], self.error_rad(starts[0], target_m, tip, axis))
        for start in starts:
            found = self._refined(start, target_m, tip, axis)
            if found.error_rad < best.error_rad - 1e-9:
                best = found
            if best.error_rad < _GOOD_RAD:
                break
        return best

    def _refined(self, start: Array, target_m: Array, tip: Array, axis: Array) -> Aim:
        """Refine joint angles by damped Gauss-Newton steps."""
        angles, damping = start.copy(), 1e-3
        error = self.error_rad(angles, target_m, tip, axis)
        for _ in range(_ROUNDS):
            value = self._residual(angles, target_m, tip, axis)
            columns = []
            for number in range(len(angles)):
                moved = angles.copy()
                moved[number] += _STEP
                columns.append((self._residual(moved, target_m, tip, axis) - value) / _STEP)
            jacobian = np.stack(columns, axis=1)
            # Joints that are pushed against their limits are excluded.
            gradient = jacobian.T @ value
            is_stuck = ((angles >= self.upper_rad) & (gradient < 0.0)) | (
                (angles <= self.lower_rad) & (gradient > 0.0)
            )
            jacobian[:, is_stuck] = 0.0
            normal = jacobian.T @ jacobian + damping * np.eye(len(angles))
            step = -np.linalg.solve(normal, jacobian.T @ value)
            tried = self.clamp(angles + np.clip(step, -0.8, 0.8))
            new_error = self.error_rad(tried, target_m, tip, axis)
            if new_error < error:
                gain = error - new_error
                angles, error, damping = tried, new_error, damping * 0.3
                if gain < 1e-7:
                    break
            else:
                damping *= 10.0
                if damping > 1e4:
                    break
        return Aim(angles, error)

    def _residual(self, angles_rad: Array, target_m: Array, tip: Array, axis: Array) -> Array:
        """Compute the direction to the target minus the axis, as unit vectors in that frame."""
        way = self._way(angles_rad, target_m, tip)
        return np.asarray(way / max(float(np.linalg.norm(way)), 1e-9) - axis)

    def _aside(
        self, angles_rad: Array, target_m: Array, tip: Array, axis: Array
    ) -> tuple[float, Array]:
        """Split the vector to the target into its component along the axis and the remainder."""
        unit = axis / np.linalg.norm(axis)
        way = self._way(angles_rad, target_m, tip)
        along = float(unit @ way)
        return along, way - along * unit

    def _way(self, angles_rad: Array, target_m: Array, tip: Array) -> Array:
        """Compute the position of the target in the pointing frame."""
        pose = self.pose(angles_rad) @ tip
        return np.asarray(pose[:3, :3].T @ (target_m - pose[:3, 3]))


def _joint(element: ElementTree.Element) -> HeadJoint:
    """Parse a joint of a URDF."""
    name = element.get('name', '')
    limit, parent, child = (element.find(each) for each in ('limit', 'parent', 'child'))
    if element.get('type') != 'revolute' or limit is None or parent is None or child is None:
        raise HeadError(f"Joint '{name}' is not a revolute joint with limits.")
    try:
        origin = np.eye(4)
        at = element.find('origin')
        if at is not None:
            origin[:3, 3] = _three(at.get('xyz', '0 0 0'))
            roll, pitch, yaw = _three(at.get('rpy', '0 0 0'))
            origin[:3, :3] = from_rpy(roll, pitch, yaw)
        about = element.find('axis')
        axis = _three(about.get('xyz', '1 0 0') if about is not None else '1 0 0')
        numbers = [float(limit.get(each, '0')) for each in ('lower', 'upper', 'velocity')]
    except ValueError as error:
        raise HeadError(f"Joint '{name}' of the robot cannot be read: {error}.") from error
    length = float(np.linalg.norm(axis))
    if not length or numbers[0] > numbers[1] or numbers[2] <= 0.0:
        raise HeadError(f"Joint '{name}' needs an axis, lower <= upper limit, and a velocity > 0.")
    return HeadJoint(
        name, parent.get('link', ''), child.get('link', ''), origin, axis / length, *numbers
    )


def _three(text: str) -> Array:
    values = np.array([float(each) for each in text.split()])
    if values.shape != (3,):
        raise ValueError(f"'{text}' is not three numbers")
    return values
