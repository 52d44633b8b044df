# SPDX-License-Identifier: Apache-2.0
"""
What describes the bodies of a robot in a posture and motion.

All are matrices (4, 4) in the axes of the world, about the origin of the root, so that nothing is
recursive (Legnani, Casolo, Righettini and Zappa, A Homogeneous Matrix Approach to 3D Kinematics
and Dynamics, Mechanism and Machine Theory 31, 1996):

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

from humanoid_control.dynamics.forward import ForwardKinematics
from humanoid_control.dynamics.rotations import skew
from humanoid_control.dynamics.tree import Tree
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BodyMatrices:
    """The matrices of n joints and n + 1 bodies, each computed when it is first asked for."""

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
        """Return (n + 1, 4, 4) of the bodies."""
        return self.forward.poses(self.rotation, self.positions_rad)

    @cached_property
    def screws(self) -> Array:
        """Return (n, 4, 4) the twists at unit rates."""
        poses = self.poses[1:]
        screws: Array = (poses[:, :3, 2] @ _SKEW).reshape(-1, 4, 4)
        np.matmul(screws[:, :3, :3], -poses[:, :3, 3:], out=screws[:, :3, 3:])
        return screws

    @cached_property
    def _motions(self) -> Array:
        """Return (n, 4, 4) the twists of joints against their parents."""
        return self.screws * self.velocities_rad_s[:, None, None]

    @cached_property
    def twists(self) -> Array:
        """Return (n + 1, 4, 4) of the bodies."""
        n = len(self.tree.joints)
        twists: Array = self.tree.moves @ self._motions.reshape(n, 16)
        twists += self.angular_velocity_rad_s @ _SKEW
        return twists.reshape(n + 1, 4, 4)

    @cached_property
    def accelerations(self) -> Array:
        """Return (n + 1, 4, 4) of the bodies in a lift that accelerates upwards by g."""
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
        """Return (n + 1, 4, 4) pseudo-inertias of the bodies."""
        poses = self.poses
        inertias: Array = poses @ self.tree.inertias @ poses.transpose(0, 2, 1)
        return inertias

    @cached_property
    def composites(self) -> Array:
        """Return (n + 1, 4, 4) pseudo-inertias of the bodies with all that hangs from them."""
        return self._hanging(self.inertias)

    @cached_property
    def forces(self) -> Array:
        """Return (n + 1, 4, 4) forces on the bodies with all that hangs from them."""
        return self._hanging(self.accelerations @ self.inertias)

    @cached_property
    def momentum(self) -> Array:
        """Return (4, 4) the momentum of the robot."""
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
            Forces (n + 1, 4, 4) on the bodies with all that hangs from each.

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
            On the bodies with all that hangs from each (n + 1, 4, 4), as in `forces`.

        Returns
        -------
        Array
            Joint torques (n,) in N m, without those that accelerate the armature.

        """
        powers: Array = (self.screws * forces[1:]).reshape(-1, 16)
        return powers @ np.ones(16)

    def _hanging(self, values: Array) -> Array:
        """Return the sums over the bodies and all that hangs from each."""
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


# A vector (3,) times this is the matrix of its cross product, (4, 4) flat.
_SKEW: Array = np.zeros((3, 4, 4))
_SKEW[:, :3, :3] = [skew(axis) for axis in np.eye(3)]
_SKEW = _SKEW.reshape(3, 16)
