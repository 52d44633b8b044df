# SPDX-License-Identifier: Apache-2.0
"""Kinematic tree of a robot: bodies and joints as arrays, forward kinematics, joint groups."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean
from humanoid_description.kinematics import chain
from humanoid_description.robot import Body, Joint, named, repeated, Robot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
TURNING = ('revolute', 'continuous')


class DynamicsError(UserError):
    """A robot model or state that the dynamics cannot handle; the message states why."""


@dataclass(frozen=True, eq=False)
class Mount:
    """Mount of a link: the index of the body that it is part of, and its pose (4, 4) in it."""

    body: int
    pose: Array


@dataclass(frozen=True, eq=False)
class Tree:
    """
    Kinematic tree of n joints and n + 1 bodies: 0 is the root, 1 + j the child of joint j.

    The frame of a body has its origin on the axis of its joint, and z along it.
    """

    joints: tuple[str, ...]
    mounts: Mapping[str, Mount]
    """mounts of all links by name"""
    parents: NDArray[np.intp]
    """(n + 1,) index of the parent body of each; the root is its own parent"""
    placements: Array
    """(n, 4, 4) poses of bodies 1 to n in their parents at zero joint positions"""
    inertias: Array
    """(n + 1, 4, 4) pseudo-inertia of each body in its frame"""

    @classmethod
    def of(cls, robot: Robot, joints: tuple[str, ...]) -> Tree:
        """
        Build the kinematic tree of a robot.

        Parameters
        ----------
        robot
            Its links and joints.
        joints
            Revolute or continuous joints, in the order of the arrays; others are fixed at zero.

        Raises
        ------
        DynamicsError
            The robot does not have exactly one root, or has no mass; or a joint is unknown,
            repeated, neither revolute nor continuous, or mimics another.

        """
        _check(robot, joints)
        mounts = _mounts(robot, joints)
        above = [mounts[robot.joint[joint].parent] for joint in joints]
        placements = [
            mount.pose @ robot.joint[joint].pose @ _z_along(robot.joint[joint].axis)
            for mount, joint in zip(above, joints)
        ]
        return cls(
            joints,
            mounts,
            np.array([0, *(mount.body for mount in above)], dtype=np.intp),
            np.array(placements).reshape(-1, 4, 4),
            _inertias(robot, mounts, len(joints) + 1),
        )

    @cached_property
    def mass_kg(self) -> float:
        """Return the mass of all bodies."""
        return float(self.inertias[:, 3, 3].sum())

    @cached_property
    def moves(self) -> Array:
        """Return (n + 1, n): 1 where the joint of the column moves the body of the row."""
        n = len(self.joints)
        moves = np.zeros((n + 1, n))
        for body in range(1, n + 1):
            above = body
            while above:
                moves[body, above - 1] = 1.0
                above = int(self.parents[above])
        return moves

    @cached_property
    def carries(self) -> Array:
        """Return (n + 1, n + 1): 1 where the column's body is, or descends from, the row's."""
        return np.vstack([np.ones(len(self.moves)), self.moves.T])


def _check(robot: Robot, joints: tuple[str, ...]) -> None:
    """Validate that the robot has one root and mass, and that its joints can be modelled."""
    if len(robot.roots) != 1:
        raise DynamicsError(
            f"Robot '{robot.name}' has {len(robot.roots)} links without a parent "
            f'({", ".join(robot.roots)}), but needs exactly one root.'
        )
    if not robot.mass_kg > 0.0:
        raise DynamicsError(f"Robot '{robot.name}' has no mass: its links need <inertial>.")
    if double := repeated(joints):
        raise DynamicsError(f"Joint '{double[0]}' is named twice. Name each joint once.")
    for name in joints:
        if name not in robot.joint:
            hint = did_you_mean(name, robot.joint)
            raise DynamicsError(f"Robot '{robot.name}' has no joint '{name}'. {hint}".rstrip())
        _check_joint(robot.joint[name])


def _check_joint(joint: Joint) -> None:
    """Reject a joint that is neither revolute nor continuous, or that mimics another."""
    if joint.kind not in TURNING:
        raise DynamicsError(
            f'{named(joint)} is {joint.kind}, but only rotating joints are supported. '
            'Leave it out to treat it as fixed at zero.'
        )
    if joint.mimics is not None:
        raise DynamicsError(
            f"{named(joint)} mimics '{joint.mimics.joint}' and does not move independently. "
            'Leave it out to treat it as fixed at zero.'
        )


def _mounts(robot: Robot, joints: tuple[str, ...]) -> dict[str, Mount]:
    """Compute the mounts of all links: the body of each, and its pose in that body."""
    body = {name: index + 1 for index, name in enumerate(joints)}
    return {link.name: _mount(chain(robot, link.name), body) for link in robot.links}


def _mount(joints: list[Joint], body: Mapping[str, int]) -> Mount:
    """Compute the mount of the link at the end of a chain of joints from the root."""
    mount = Mount(0, np.eye(4))
    for joint in joints:
        if joint.name in body:
            mount = Mount(body[joint.name], _z_along(joint.axis).T)
        else:
            mount = Mount(mount.body, mount.pose @ joint.pose)
    return mount


def _z_along(axis: Array) -> Array:
    """Return the pose (4, 4) of a frame whose z points along an axis."""
    z = axis / np.linalg.norm(axis)
    # The coordinate axis that is farthest from z: no rounding if z lies along one of them.
    other = np.eye(3)[int(np.argmin(np.abs(z)))]
    y = np.cross(z, other)
    y /= np.linalg.norm(y)
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([np.cross(y, z), y, z])
    return pose


def _inertias(robot: Robot, mounts: Mapping[str, Mount], count: int) -> Array:
    """Sum the pseudo-inertias of the links of each body, (count, 4, 4)."""
    inertias = np.zeros((count, 4, 4))
    for link in robot.links:
        if link.body:
            mount = mounts[link.name]
            pose = mount.pose @ link.body.pose
            inertias[mount.body] += pose @ _pseudo_inertia(link.body) @ pose.T
    return inertias


def _pseudo_inertia(body: Body) -> Array:
    """
    Compute the integral of r r^T dm over a body, r = (x, y, z, 1), at its centre of mass.

    It is equivalent to mass, centre of mass and inertia, and a pose T transforms it to T J T^T
    (Wensing, Kim and Slotine, Linear Matrix Inequalities for Physically Consistent Inertial
    Parameter Identification, IEEE RA-L 2018).
    """
    inertia = np.asarray(body.inertia_kgm2, float)
    pseudo = np.zeros((4, 4))
    pseudo[:3, :3] = 0.5 * np.trace(inertia) * np.eye(3) - inertia
    pseudo[3, 3] = body.mass_kg
    return pseudo


@dataclass(frozen=True, eq=False)
class ForwardKinematics:
    """
    Forward kinematics by pointer jumping: one round for each binary digit of the tree's depth.

    Each round doubles the number of joints that a pose spans: it is multiplied by the pose of the
    body at which it ended (Hillis and Steele, Data Parallel Algorithms, CACM 1986).
    """

    turned: Array
    """(n, 3, 16) poses in the parents, flat: the coefficients of 1, sin q and cos q"""
    jumps: tuple[NDArray[np.intp], ...]
    """(n + 1,) per round: index of the ancestor; n + 1, a fixed identity, where there is none"""
    at_rest: Array
    """(n + 2, 4, 4) identities: of the root, the other bodies, and the fixed one"""

    @classmethod
    def of(cls, tree: Tree) -> ForwardKinematics:
        """
        Precompute the tables of a kinematic tree.

        Parameters
        ----------
        tree
            Its n joints and n + 1 bodies.

        """
        at_rest = np.tile(np.eye(4), (len(tree.parents) + 1, 1, 1))
        return cls(_turned(tree.placements), _jumps(tree.parents), at_rest)

    def poses(self, rotation: Array, positions_rad: Array) -> Array:
        """
        Compute the poses of all bodies.

        Parameters
        ----------
        rotation
            Rotation (3, 3) of the root in the world.
        positions_rad
            Joint positions (n,).

        Returns
        -------
        Array
            Homogeneous transforms (n + 1, 4, 4) from the bodies to the axes of the world, with the
            origin of the root at zero.

        """
        n = len(self.turned)
        factors = np.ones((n, 1, 3))
        np.sin(positions_rad, out=factors[:, 0, 1])
        np.cos(positions_rad, out=factors[:, 0, 2])
        whole = self.at_rest.copy()
        poses: Array = whole[:-1]
        poses[0, :3, :3] = rotation
        np.matmul(factors, self.turned, out=poses[1:].reshape(n, 1, 16))
        for jump in self.jumps:
            poses[:] = whole.take(jump, axis=0) @ poses
        return poses


def _turned(placements: Array) -> Array:
    """Compute the poses of frames that rotate about z, as coefficients of 1, sin and cos."""
    x, y = placements[:, :, 0], placements[:, :, 1]
    turned = np.zeros((len(placements), 3, 4, 4))
    turned[:, 0, :, 2:] = placements[:, :, 2:]
    turned[:, 1, :, 0], turned[:, 1, :, 1] = y, -x
    turned[:, 2, :, 0], turned[:, 2, :, 1] = x, y
    return turned.reshape(-1, 3, 16)


def _jumps(parents: NDArray[np.intp]) -> tuple[NDArray[np.intp], ...]:
    """Compute, for each round, the ancestor at which the pose of each body ends."""
    nowhere = len(parents)
    above = np.append(parents, nowhere)
    above[0] = nowhere
    rounds = []
    while np.any(above != nowhere):
        rounds.append(above[:-1])
        above = above[above]
    return tuple(rounds)


@dataclass(frozen=True, eq=False)
class JointGroup:
    """Subset of the joints of a model, in its own order, as `BodyModel.group` returns it."""

    joints: tuple[str, ...]
    indices: NDArray[np.intp]
    """(k,) their indices in the model"""
    carries: Array
    """(k, k) 1 where the joint of the row moves all that the joint of the column moves"""
    armature_kgm2: Array
    """(k, k) diagonal"""

    @classmethod
    def of(
        cls,
        joints: tuple[str, ...],
        indices: NDArray[np.intp],
        moves: Array,
        armature_kgm2: Array,
    ) -> JointGroup:
        """
        Build a group from the tables of a model; `BodyModel.group` calls it.

        Parameters
        ----------
        joints, indices
            Names of the k joints, and their indices (k,) in the model.
        moves
            Which joints move which bodies (n + 1, n), from `Tree.moves`.
        armature_kgm2
            Armature of all joints of the model (n,).

        """
        carries = moves[indices + 1][:, indices].T.copy()
        return cls(joints, indices, carries, np.diag(armature_kgm2[indices]))

    def symmetric(self, below: Array) -> Array:
        """
        Complete a symmetric matrix of which only the elements marked in `carries` are valid.

        Parameters
        ----------
        below
            The matrix (k, k); its other elements are ignored.

        Returns
        -------
        Array
            The full matrix (k, k), zero between joints of which neither carries the other.

        """
        right = below * self._shares
        whole: Array = right + right.T
        return whole

    @cached_property
    def _shares(self) -> Array:
        """Return the weights (k, k) of a matrix that is added to its transpose."""
        shares: Array = self.carries - 0.5 * np.eye(len(self.carries))
        return shares
