# SPDX-License-Identifier: Apache-2.0
"""
A robot in a posture and motion, and what follows from it.

Everything is said in matrices (4, 4) in the axes of the world, about the origin of the root, so
that nothing is recursive (Legnani, Casolo, Righettini and Zappa, A Homogeneous Matrix Approach to
3D Kinematics and Dynamics, Mechanism and Machine Theory 31, 1996):

- The twist W of a body gives the velocity W r of each of its points r = (x, y, z, 1). The twist
  of a body is the sum over the joints above it: of the screw L of the joint times its rate.
- The acceleration is H r; H is the sum of (2 W - L dq) L dq over the joints above, where W is the
  twist below the joint.
- With the pseudo-inertia J (the integral of r r^T dm), W J holds the momentum and H J the forces:
  the last column is linear, the antisymmetric part angular. The power of forces F on a motion W is
  the sum of the products of their entries.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from humanoid_common.naming import did_you_mean
from humanoid_control.dynamics.errors import DynamicsError
from humanoid_control.dynamics.joint_group import JointGroup
from humanoid_control.dynamics.rotations import skew
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from humanoid_control.dynamics.body_model import BodyModel
    from humanoid_control.dynamics.tree import Mount

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BodyState:
    """
    A robot of n joints, of which the origin of the root is at zero and does not move.

    `BodyModel.state` makes it. Points, vectors and wrenches are in the axes of the world; points
    are seen from the origin of the root. Each quantity is computed when it is first asked for.
    """

    model: BodyModel
    base_rotation: Array
    """(3, 3)"""
    base_angular_velocity_rad_s: Array
    """(3,) in the axes of the world"""
    positions_rad: Array
    """(n,)"""
    velocities_rad_s: Array
    """(n,)"""

    def pose(self, link: str) -> Array:
        """Return where a link is, and how it is turned, as (4, 4)."""
        mount = self._mount(link)
        pose: Array = self._poses[mount.body] @ mount.pose
        return pose

    def position_m(self, link: str) -> Array:
        """Return where the origin of a link is, (3,)."""
        mount = self._mount(link)
        position: Array = (self._poses[mount.body] @ mount.pose[:, 3])[:3]
        return position

    def rotation(self, link: str) -> Array:
        """Return how a link is turned, (3, 3)."""
        mount = self._mount(link)
        rotation: Array = self._poses[mount.body, :3, :3] @ mount.pose[:3, :3]
        return rotation

    def velocity_m_s(self, link: str, point_m: Array | None = None) -> Array:
        """Return the velocity (3,) of a point (3,) of a link; without a point of its origin."""
        mount = self._mount(link)
        velocity: Array = self._twists[mount.body, :3] @ self._point(mount, point_m)
        return velocity

    def angular_velocity_rad_s(self, link: str) -> Array:
        """Return the angular velocity (3,) of a link."""
        twist = self._twists[self._mount(link).body]
        return np.array([twist[2, 1], twist[0, 2], twist[1, 0]])

    @cached_property
    def com_m(self) -> Array:
        """Return the centre of mass (3,)."""
        com: Array = self._composites[0, :3, 3] / self.model.mass_kg
        return com

    @cached_property
    def com_velocity_m_s(self) -> Array:
        """Return the velocity (3,) of the centre of mass."""
        velocity: Array = self._momentum[:3, 3] / self.model.mass_kg
        return velocity

    @cached_property
    def angular_momentum_nms(self) -> Array:
        """Return the angular momentum (3,) about the centre of mass."""
        about_origin = _axial(self._momentum)
        of_com: Array = skew(self.com_m) @ self._momentum[:3, 3]
        return about_origin - of_com

    @cached_property
    def bias_nm(self) -> Array:
        """
        Return the efforts (n,) of the joints that gravity and motion ask for.

        That is with all accelerations zero: neither the joints nor the root accelerate, and
        nothing touches the robot.
        """
        return self._efforts(self._forces)

    @cached_property
    def bias_wrench(self) -> Array:
        """Return what holds the root meanwhile: force (N) and torque (Nm) at its origin, (6,)."""
        return _wrench(self._forces[0])

    def required(self, base: Array, joints_rad_s2: Array) -> tuple[Array, Array]:
        """
        Return what accelerates the robot: the wrench (6,) on its root, and the efforts (n,).

        This is inverse dynamics, with the armature. The wrench is force and torque at the origin
        of the root; without accelerations the answer is the bias.

        :param base: linear (m/s2) and angular (rad/s2) acceleration of the root, (6,)
        :param joints_rad_s2: accelerations of the joints, (n,)
        """
        n = len(self.model.joints)
        own = (self._screws * joints_rad_s2[:, None, None]).reshape(n, 16)
        added: Array = (self.model.tree.moves @ own).reshape(n + 1, 4, 4)
        root = (base[3:] @ _SKEW).reshape(4, 4)
        root[:3, 3] = base[:3]
        forces = self._hanging((self._accelerations + added + root) @ self._inertias)
        return _wrench(forces[0]), self._efforts(forces) + self.model.armature_kgm2 * joints_rad_s2

    def jacobian(self, link: str, point_m: Array | None = None) -> Array:
        """
        Return the Jacobian (3, 6 + n) of the velocity of a point (3,) of a link.

        Without a point it is the origin of the link. Columns: the linear velocity of the root,
        its angular velocity (both in the axes of the world), the joints.
        """
        mount = self._mount(link)
        point = self._point(mount, point_m)
        n = len(self.model.joints)
        jacobian = np.empty((3, 6 + n))
        jacobian[:, :3] = np.eye(3)
        jacobian[:, 3:6] = -skew(point[:3])
        moved = (self._screws.reshape(-1, 4) @ point).reshape(n, 4).T[:3]
        np.multiply(moved, self.model.tree.moves[mount.body], out=jacobian[:, 6:])
        return jacobian

    def angular_jacobian(self, link: str) -> Array:
        """Return the Jacobian (3, 6 + n) of the angular velocity of a link; columns as above."""
        n = len(self.model.joints)
        jacobian = np.zeros((3, 6 + n))
        jacobian[:, 3:6] = np.eye(3)
        jacobian[:, 6:] = self._poses[1:, :3, 2].T * self.model.tree.moves[self._mount(link).body]
        return jacobian

    def jacobian_of(self, group: JointGroup, link: str) -> Array:
        """
        Return the Jacobian (6, k) of a link for the joints of a group alone.

        Rows: the linear velocity of its origin, then its angular velocity.
        """
        mount, k = self._mount(link), len(group.indices)
        moved = self._screws[group.indices].reshape(-1, 4) @ self._point(mount, None)
        jacobian = np.empty((6, k))
        jacobian[:3] = moved.reshape(k, 4).T[:3]
        jacobian[3:] = self._poses[group.indices + 1, :3, 2].T
        jacobian *= self.model.tree.moves[mount.body, group.indices]
        return jacobian

    @cached_property
    def com_jacobian(self) -> Array:
        """Return the Jacobian (3, 6 + n) of the velocity of the centre of mass."""
        n = len(self.model.joints)
        jacobian = np.empty((3, 6 + n))
        jacobian[:, :3] = np.eye(3)
        jacobian[:, 3:6] = -skew(self.com_m)
        momenta = self._screws[:, :3] @ self._composites[1:, :, 3:]
        np.divide(momenta[:, :, 0].T, self.model.mass_kg, out=jacobian[:, 6:])
        return jacobian

    @cached_property
    def com_drift_m_s2(self) -> Array:
        """Return the acceleration (3,) of the centre of mass while no joint accelerates."""
        drift: Array = self._forces[0, :3, 3] / self.model.mass_kg
        drift[2] -= self.model.gravity_m_s2
        return drift

    def drift(self, link: str) -> Array:
        """
        Return the acceleration (6,) of a link while neither the root nor the joints accelerate.

        Linear (m/s2) of its origin, then angular (rad/s2): what their Jacobians leave out.
        """
        mount = self._mount(link)
        acceleration = self._accelerations[mount.body]
        linear: Array = acceleration[:3] @ self._point(mount, None)
        linear[2] -= self.model.gravity_m_s2
        return np.concatenate([linear, 0.5 * _axial(acceleration)])

    def efforts_of_force_nm(
        self, link: str, point_m: Array, force_n: Array, torque_nm: Array | None = None
    ) -> Array:
        """
        Return the efforts (n,) that a force (3,) on a point (3,) of a link has at the joints.

        It is the Jacobian's transpose times the force, without the Jacobian. To stand on the
        point, joints exert the bias less this. A torque (3,) on the link is added if given.
        """
        mount = self._mount(link)
        point = self._point(mount, point_m)
        wrench = np.zeros((4, 4))
        np.multiply(force_n[:, None], point, out=wrench[:3])
        if torque_nm is not None:
            wrench[:3, :3] += 0.5 * skew(torque_nm)
        efforts: Array = self._screws.reshape(-1, 16) @ wrench.ravel()
        efforts *= self.model.tree.moves[mount.body]
        return efforts

    def inertia_kgm2(self, group: JointGroup) -> Array:
        """
        Return the inertia (k, k) of the joints of a group, with the armature.

        It maps their accelerations to their efforts while the root and the other joints do not
        accelerate (composite rigid bodies: Featherstone, Rigid Body Dynamics Algorithms, 6.2).
        """
        screws = self._screws[group.indices]
        momenta = screws @ self._composites[group.indices + 1]
        k = len(group.indices)
        below = screws.reshape(k, 16) @ momenta.reshape(k, 16).T
        return group.symmetric(below) + group.armature_kgm2

    def _mount(self, link: str) -> Mount:
        """Return where a link is."""
        mount = self.model.links.get(link)
        if mount is None:
            hint = did_you_mean(link, self.model.links)
            raise DynamicsError(f"The model has no link '{link}'. {hint}".rstrip())
        return mount

    def _point(self, mount: Mount, point_m: Array | None) -> Array:
        """Return a point, or the origin of a link, as (4,)."""
        if point_m is None:
            origin: Array = self._poses[mount.body] @ mount.pose[:, 3]
            return origin
        point = np.ones(4)
        point[:3] = point_m
        return point

    @cached_property
    def _poses(self) -> Array:
        """Return (n + 1, 4, 4) of the bodies."""
        return self.model.forward.poses(self.base_rotation, self.positions_rad)

    @cached_property
    def _screws(self) -> Array:
        """Return (n, 4, 4) the twists at unit rates."""
        poses = self._poses[1:]
        screws: Array = (poses[:, :3, 2] @ _SKEW).reshape(-1, 4, 4)
        np.matmul(screws[:, :3, :3], -poses[:, :3, 3:], out=screws[:, :3, 3:])
        return screws

    @cached_property
    def _motions(self) -> Array:
        """Return (n, 4, 4) the twists of joints against their parents."""
        return self._screws * self.velocities_rad_s[:, None, None]

    @cached_property
    def _twists(self) -> Array:
        """Return (n + 1, 4, 4) of the bodies."""
        n = len(self.model.joints)
        twists: Array = self.model.tree.moves @ self._motions.reshape(n, 16)
        twists += self.base_angular_velocity_rad_s @ _SKEW
        return twists.reshape(n + 1, 4, 4)

    @cached_property
    def _accelerations(self) -> Array:
        """Return (n + 1, 4, 4) of the bodies in a lift that accelerates upwards by g."""
        n = len(self.model.joints)
        motions = self._motions
        centripetal = (2.0 * self._twists[1:] - motions) @ motions
        accelerations: Array = (self.model.tree.moves @ centripetal.reshape(n, 16)).reshape(
            n + 1, 4, 4
        )
        root = self._twists[0] @ self._twists[0]
        root[2, 3] += self.model.gravity_m_s2
        accelerations += root
        return accelerations

    @cached_property
    def _inertias(self) -> Array:
        """Return (n + 1, 4, 4) pseudo-inertias of the bodies."""
        poses = self._poses
        inertias: Array = poses @ self.model.tree.inertias @ poses.transpose(0, 2, 1)
        return inertias

    @cached_property
    def _composites(self) -> Array:
        """Return (n + 1, 4, 4) pseudo-inertias of the bodies with all that hangs from them."""
        return self._hanging(self._inertias)

    @cached_property
    def _forces(self) -> Array:
        """Return (n + 1, 4, 4) forces on the bodies with all that hangs from them."""
        return self._hanging(self._accelerations @ self._inertias)

    @cached_property
    def _momentum(self) -> Array:
        """Return (4, 4) the momentum of the robot."""
        momentum: Array = (self._twists @ self._inertias).sum(axis=0)
        return momentum

    def _efforts(self, forces: Array) -> Array:
        """Return the efforts (n,) of joints for forces (n + 1, 4, 4) on all that they carry."""
        powers = (self._screws * forces[1:]).reshape(-1, 16)
        return powers @ np.ones(16)

    def _hanging(self, values: Array) -> Array:
        """Return the sums over the bodies and all that hangs from each."""
        sums: Array = self.model.tree.carries @ values.reshape(-1, 16)
        return sums.reshape(-1, 4, 4)


def _wrench(forces: Array) -> Array:
    """Return force and torque (6,) of forces (4, 4)."""
    return np.concatenate([forces[:3, 3], _axial(forces)])


def _axial(moments: Array) -> Array:
    """Return the integral of r x f (3,), of that of f r^T."""
    return np.array(
        [
            moments[2, 1] - moments[1, 2],
            moments[0, 2] - moments[2, 0],
            moments[1, 0] - moments[0, 1],
        ]
    )


# A vector (3,) times this is the matrix of its cross product, (4, 4) flat.
_SKEW: Array = np.zeros((3, 4, 4))
_SKEW[:, :3, :3] = [skew(axis) for axis in np.eye(3)]
_SKEW = _SKEW.reshape(3, 16)
