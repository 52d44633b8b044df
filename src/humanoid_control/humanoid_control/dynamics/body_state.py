# SPDX-License-Identifier: Apache-2.0
"""Dynamics of a robot in a posture and motion: centre of mass, Jacobians, forces, inertia."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from humanoid_control.dynamics.body_matrices import axial, LinkMotions
from humanoid_control.dynamics.tree import JointGroup
from humanoid_description.rotations import skew
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BodyState(LinkMotions):
    """
    State of a robot with n joints; the origin of its root is at zero and at rest.

    `BodyModel.state` builds it. Points, vectors and wrenches are in the axes of the world; points
    are relative to the origin of the root. Each quantity is computed on first access; cached
    arrays are read-only (copy them to modify them). Methods that take the name of a link raise
    `DynamicsError` if the model does not have it.
    """

    armature_kgm2: Array
    """(n,)"""

    @cached_property
    def com_m(self) -> Array:
        """Return the centre of mass (3,)."""
        return _kept(self.matrices.composites[0, :3, 3] / self.tree.mass_kg)

    @cached_property
    def com_velocity_m_s(self) -> Array:
        """Return the velocity (3,) of the centre of mass."""
        return _kept(self.matrices.momentum[:3, 3] / self.tree.mass_kg)

    @cached_property
    def angular_momentum_nms(self) -> Array:
        """Return the angular momentum (3,) about the centre of mass."""
        of_com: Array = skew(self.com_m) @ self.matrices.momentum[:3, 3]
        return _kept(axial(self.matrices.momentum) - of_com)

    @cached_property
    def bias_nm(self) -> Array:
        """
        Return the joint torques (n,) that gravity and motion require.

        They hold at zero acceleration of the root and the joints, without contacts.
        """
        return _kept(self.matrices.efforts(self.matrices.forces))

    @cached_property
    def bias_wrench(self) -> Array:
        """Return the root wrench (6,) of the bias: force (N), then torque (N m) at its origin."""
        return _kept(_wrench(self.matrices.forces[0]))

    def required(self, base: Array, joints_rad_s2: Array) -> tuple[Array, Array]:
        """
        Compute inverse dynamics: the root wrench and joint torques that accelerate the robot.

        The armature is included. Without accelerations the result is the bias.

        Parameters
        ----------
        base
            Acceleration of the root (6,): linear in m/s2, then angular in rad/s2, in world axes.
        joints_rad_s2
            Accelerations of the joints (n,).

        Returns
        -------
        tuple[Array, Array]
            The wrench (6,) on the root: force in N, then torque in N m about its origin; and the
            joint torques (n,) in N m.

        """
        forces = self.matrices.forces_of(base, joints_rad_s2)
        efforts = self.matrices.efforts(forces) + self.armature_kgm2 * joints_rad_s2
        return _wrench(forces[0]), efforts

    @cached_property
    def com_jacobian(self) -> Array:
        """Return the Jacobian (3, 6 + n) of the velocity of the centre of mass."""
        n = len(self.tree.joints)
        jacobian = np.empty((3, 6 + n))
        jacobian[:, :3] = np.eye(3)
        jacobian[:, 3:6] = -skew(self.com_m)
        momenta = self.matrices.screws[:, :3] @ self.matrices.composites[1:, :, 3:]
        np.divide(momenta[:, :, 0].T, self.tree.mass_kg, out=jacobian[:, 6:])
        return _kept(jacobian)

    @cached_property
    def com_drift_m_s2(self) -> Array:
        """Return the acceleration bias (3,) of the centre of mass, as `drift` of a link."""
        drift: Array = self.matrices.forces[0, :3, 3] / self.tree.mass_kg
        drift[2] -= self.matrices.gravity_m_s2
        return _kept(drift)

    def jacobian(self, link: str, point_m: Array | None = None) -> Array:
        """
        Compute the Jacobian of the velocity of a point of a link.

        Parameters
        ----------
        link
            Its name.
        point_m
            The point (3,), in the axes of the world from the origin of the root; without one, the
            origin of the link.

        Returns
        -------
        Array
            Jacobian (3, 6 + n). Columns: the linear velocity of the root, its angular velocity
            (both in the axes of the world), the joints.

        """
        mount = self._mount(link)
        point = self._point(mount, point_m)
        n = len(self.tree.joints)
        jacobian = np.empty((3, 6 + n))
        jacobian[:, :3] = np.eye(3)
        jacobian[:, 3:6] = -skew(point[:3])
        moved = (self.matrices.screws.reshape(-1, 4) @ point).reshape(n, 4).T[:3]
        np.multiply(moved, self.tree.moves[mount.body], out=jacobian[:, 6:])
        return jacobian

    def angular_jacobian(self, link: str) -> Array:
        """
        Compute the Jacobian of the angular velocity of a link.

        Parameters
        ----------
        link
            Its name.

        Returns
        -------
        Array
            Jacobian (3, 6 + n), with the columns of `jacobian`.

        """
        n = len(self.tree.joints)
        jacobian = np.zeros((3, 6 + n))
        jacobian[:, 3:6] = np.eye(3)
        jacobian[:, 6:] = (
            self.matrices.poses[1:, :3, 2].T * self.tree.moves[self._mount(link).body]
        )
        return jacobian

    def jacobian_of(self, group: JointGroup, link: str) -> Array:
        """
        Compute the Jacobian of a link for the joints of a group alone.

        Parameters
        ----------
        group
            The k joints, from `BodyModel.group`.
        link
            The name of the link.

        Returns
        -------
        Array
            Jacobian (6, k). Rows: the linear velocity of the origin, then the angular velocity.

        """
        mount, k = self._mount(link), len(group.indices)
        moved = self.matrices.screws[group.indices].reshape(-1, 4) @ self._point(mount, None)
        jacobian = np.empty((6, k))
        jacobian[:3] = moved.reshape(k, 4).T[:3]
        jacobian[3:] = self.matrices.poses[group.indices + 1, :3, 2].T
        jacobian *= self.tree.moves[mount.body, group.indices]
        return jacobian

    def efforts_of_force_nm(
        self, link: str, point_m: Array, force_n: Array, torque_nm: Array | None = None
    ) -> Array:
        """
        Map a force on a link to joint torques by the Jacobian transpose, without the Jacobian.

        To stand on the point, the joints exert `bias_nm` minus the result.

        Parameters
        ----------
        link
            Its name.
        point_m
            Point of application (3,), in the axes of the world from the origin of the root.
        force_n
            Force (3,) on the link, in the axes of the world.
        torque_nm
            Additional torque (3,) on the link, in the axes of the world.

        Returns
        -------
        Array
            Joint torques (n,) in N m that the force exerts on the joints.

        """
        mount = self._mount(link)
        point = self._point(mount, point_m)
        wrench = np.zeros((4, 4))
        np.multiply(force_n[:, None], point, out=wrench[:3])
        if torque_nm is not None:
            wrench[:3, :3] += 0.5 * skew(torque_nm)
        efforts: Array = self.matrices.screws.reshape(-1, 16) @ wrench.ravel()
        efforts *= self.tree.moves[mount.body]
        return efforts

    def inertia_kgm2(self, group: JointGroup) -> Array:
        """
        Compute the joint-space inertia matrix of a group, with the armature.

        It maps their accelerations to their torques while the root and the other joints do not
        accelerate (composite rigid bodies: Featherstone, Rigid Body Dynamics Algorithms, 6.2).

        Parameters
        ----------
        group
            The k joints, from `BodyModel.group`.

        Returns
        -------
        Array
            Symmetric matrix (k, k) in kg m2.

        """
        screws = self.matrices.screws[group.indices]
        momenta = screws @ self.matrices.composites[group.indices + 1]
        k = len(group.indices)
        below = screws.reshape(k, 16) @ momenta.reshape(k, 16).T
        return group.symmetric(below) + group.armature_kgm2


def _wrench(forces: Array) -> Array:
    """Extract the wrench (6,), force and torque, from a force matrix (4, 4)."""
    return np.concatenate([forces[:3, 3], axial(forces)])


def _kept(values: Array) -> Array:
    """Make an array read-only, since it is cached."""
    values.setflags(write=False)
    return values
