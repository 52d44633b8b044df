# SPDX-License-Identifier: Apache-2.0
"""
Poses, twists, accelerations and inertias of the bodies of a robot, as homogeneous matrices.

All are matrices (4, 4) in the axes of the world, about the origin of the root, so that no
recursion is needed (Legnani, Casolo, Righettini and Zappa, A Homogeneous Matrix Approach to 3D
Kinematics and Dynamics, Mechanism and Machine Theory 31, 1996):

- The twist W of a body gives the velocity W r of each of its points r = (x, y, z, 1). It is the
  sum, over the joints above the body, of the screw L of the joint times its rate dq.
- The acceleration is H r; H is the sum of (2 W - L dq) L dq over the joints above, where W is the
  twist below the joint.
- With the pseudo-inertia J (the integral of r r^T dm), W J is the momentum and H J the force: the
  last column is the linear part, the antisymmetric part the angular one. The power of forces F on
  a motion W is the sum of their elementwise products.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from humanoid_control.dynamics.tree import Tree
from humanoid_description.rotations import skew
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# A vector (3,) times this is its skew-symmetric matrix (cross product), (4, 4) flat.
_SKEW: Array = np.zeros((3, 4, 4))
_SKEW[:, :3, :3] = [skew(axis) for axis in np.eye(3)]
_SKEW = _SKEW.reshape(3, 16)


@dataclass(frozen=True, eq=False)
class BodyMatrices:
    """Matrices of n joints and n + 1 bodies, each computed on first access."""

    tree: Tree
    forward: ForwardKinematics
    gravity_m_s2: float
    rotation: Array
    """(3, 3) of the root"""
    angular_velocity_rad_s: Array
    """(3,) of the root, in the axes of the world"""
    positions_rad: Array
    """(n,)"""
    velocities_rad_s: Array
    """(n,)"""

    @cached_property
    def poses(self) -> Array:
        """Return the poses of the bodies (n + 1, 4, 4)."""
        return self.forward.poses(self.rotation, self.positions_rad)

    @cached_property
    def screws(self) -> Array:
        """Return the screws of the joints: their twists at unit rates (n, 4, 4)."""
        poses = self.poses[1:]
        screws: Array = (poses[:, :3, 2] @ _SKEW).reshape(-1, 4, 4)
        np.matmul(screws[:, :3, :3], -poses[:, :3, 3:], out=screws[:, :3, 3:])
        return screws

    @cached_property
    def _motions(self) -> Array:
        """Return the twists (n, 4, 4) of bodies 1 to n relative to their parents."""
        return self.screws * self.velocities_rad_s[:, None, None]

    @cached_property
    def twists(self) -> Array:
        """Return the twists of the bodies (n + 1, 4, 4)."""
        n = len(self.tree.joints)
        twists: Array = self.tree.moves @ self._motions.reshape(n, 16)
        twists += self.angular_velocity_rad_s @ _SKEW
        return twists.reshape(n + 1, 4, 4)

    @cached_property
    def accelerations(self) -> Array:
        """Return the bias accelerations, with the root accelerating upwards by g (n + 1, 4, 4)."""
        n = len(self.tree.joints)
        motions = self._motions
        centripetal = (2.0 * self.twists[1:] - motions) @ motions
        accelerations: Array = (self.tree.moves @ centripetal.reshape(n, 16)).reshape(n + 1, 4, 4)
        root = self.twists[0] @ self.twists[0]
        root[2, 3] += self.gravity_m_s2
        accelerations += root
        return accelerations

    @cached_property
    def inertias(self) -> Array:
        """Return the pseudo-inertias of the bodies (n + 1, 4, 4)."""
        poses = self.poses
        inertias: Array = poses @ self.tree.inertias @ poses.transpose(0, 2, 1)
        return inertias

    @cached_property
    def composites(self) -> Array:
        """Return the composite pseudo-inertias (n + 1, 4, 4) of each body and its descendants."""
        return self._hanging(self.inertias)

    @cached_property
    def forces(self) -> Array:
        """Return the bias forces, each on a body and its descendants (n + 1, 4, 4)."""
        return self._hanging(self.accelerations @ self.inertias)

    @cached_property
    def momentum(self) -> Array:
        """Return the momentum of the robot (4, 4)."""
        momentum: Array = (self.twists @ self.inertias).sum(axis=0)
        return momentum

    def forces_of(self, base: Array, joints_rad_s2: Array) -> Array:
        """
        Compute `forces` for given accelerations of root and joints.

        Parameters
        ----------
        base
            Acceleration of the root (6,): linear in m/s2, then angular in rad/s2, in world axes.
        joints_rad_s2
            Accelerations of the joints (n,).

        Returns
        -------
        Array
            Forces (n + 1, 4, 4), each on a body and its descendants.

        """
        n = len(self.tree.joints)
        own = (self.screws * joints_rad_s2[:, None, None]).reshape(n, 16)
        added: Array = (self.tree.moves @ own).reshape(n + 1, 4, 4)
        root = (base[3:] @ _SKEW).reshape(4, 4)
        root[:3, 3] = base[:3]
        return self._hanging((self.accelerations + added + root) @ self.inertias)

    def efforts(self, forces: Array) -> Array:
        """
        Project forces onto the joints.

        Parameters
        ----------
        forces
            Forces (n + 1, 4, 4), each on a body and its descendants, as in `forces`.

        Returns
        -------
        Array
            Joint torques (n,) in N m, without those that accelerate the armature.

        """
        powers: Array = (self.screws * forces[1:]).reshape(-1, 16)
        return powers @ np.ones(16)

    def _hanging(self, values: Array) -> Array:
        """Sum values (n + 1, 4, 4) over each body and its descendants."""
        sums: Array = self.tree.carries @ values.reshape(-1, 16)
        return sums.reshape(-1, 4, 4)


def axial(moments: Array) -> Array:
    """
    Extract the total moment of forces from their matrix.

    It is twice the axial vector of the antisymmetric part.

    Parameters
    ----------
    moments
        The integral of f r^T over forces f at points r: (3, 3), or (4, 4) for homogeneous r and f.

    Returns
    -------
    Array
        The integral of r x f (3,).

    """
    return np.array(
        [
            moments[2, 1] - moments[1, 2],
            moments[0, 2] - moments[2, 0],
            moments[1, 0] - moments[0, 1],
        ]
    )


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
