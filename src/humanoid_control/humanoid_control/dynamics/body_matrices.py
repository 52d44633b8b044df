# SPDX-License-Identifier: Apache-2.0
"""
Poses, twists, accelerations and inertias of bodies and their links, as homogeneous matrices.

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

from humanoid_common.naming import did_you_mean
from humanoid_control.dynamics.tree import DynamicsError, ForwardKinematics, Mount, Tree
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
class LinkMotions:
    """
    Poses, velocities and bias accelerations of the links of a robot.

    Points and vectors are in the axes of the world; points are relative to the origin of the root.
    Methods that take the name of a link raise `DynamicsError` if the model does not have it.
    """

    tree: Tree
    matrices: BodyMatrices

    @property
    def base_rotation(self) -> Array:
        """Return the rotation matrix (3, 3) of the root in the world."""
        return self.matrices.rotation

    @property
    def base_angular_velocity_rad_s(self) -> Array:
        """Return the angular velocity (3,) of the root, in the axes of the world."""
        return self.matrices.angular_velocity_rad_s

    @property
    def velocities_rad_s(self) -> Array:
        """Return the joint velocities (n,)."""
        return self.matrices.velocities_rad_s

    def pose(self, link: str) -> Array:
        """
        Compute the pose of a link.

        Parameters
        ----------
        link
            Its name.

        Returns
        -------
        Array
            Homogeneous transform (4, 4) from the link to the axes of the world, with the origin of
            the root at zero.

        """
        mount = self._mount(link)
        pose: Array = self.matrices.poses[mount.body] @ mount.pose
        return pose

    def position_m(self, link: str) -> Array:
        """
        Compute the position (3,) of the origin of a link.

        Parameters
        ----------
        link
            Its name.

        """
        mount = self._mount(link)
        position: Array = (self.matrices.poses[mount.body] @ mount.pose[:, 3])[:3]
        return position

    def rotation(self, link: str) -> Array:
        """
        Compute the rotation matrix (3, 3) of a link in the world.

        Parameters
        ----------
        link
            Its name.

        """
        mount = self._mount(link)
        rotation: Array = self.matrices.poses[mount.body, :3, :3] @ mount.pose[:3, :3]
        return rotation

    def velocity_m_s(self, link: str, point_m: Array | None = None) -> Array:
        """
        Compute the velocity (3,) of a point of a link.

        Parameters
        ----------
        link
            Its name.
        point_m
            The point (3,), in the axes of the world from the origin of the root; without one, the
            origin of the link.

        """
        mount = self._mount(link)
        velocity: Array = self.matrices.twists[mount.body, :3] @ self._point(mount, point_m)
        return velocity

    def angular_velocity_rad_s(self, link: str) -> Array:
        """
        Compute the angular velocity (3,) of a link, in the axes of the world.

        Parameters
        ----------
        link
            Its name.

        """
        twist = self.matrices.twists[self._mount(link).body]
        return np.array([twist[2, 1], twist[0, 2], twist[1, 0]])

    def drift(self, link: str) -> Array:
        """
        Compute the acceleration bias of a link, the product of Jacobian derivative and velocities.

        It is the acceleration of the link at zero acceleration of the root and the joints.

        Parameters
        ----------
        link
            Its name.

        Returns
        -------
        Array
            Acceleration (6,): linear in m/s2 of its origin, then angular in rad/s2.

        """
        mount = self._mount(link)
        acceleration = self.matrices.accelerations[mount.body]
        linear: Array = acceleration[:3] @ self._point(mount, None)
        linear[2] -= self.matrices.gravity_m_s2
        return np.concatenate([linear, 0.5 * axial(acceleration)])

    def _mount(self, link: str) -> Mount:
        """Look up the mount of a link."""
        mount = self.tree.mounts.get(link)
        if mount is None:
            hint = did_you_mean(link, self.tree.mounts)
            raise DynamicsError(f"The model has no link '{link}'. {hint}".rstrip())
        return mount

    def _point(self, mount: Mount, point_m: Array | None) -> Array:
        """Return a point, or the origin of a link, in homogeneous coordinates (4,)."""
        if point_m is None:
            origin: Array = self.matrices.poses[mount.body] @ mount.pose[:, 3]
            return origin
        point = np.ones(4)
        point[:3] = point_m
        return point
