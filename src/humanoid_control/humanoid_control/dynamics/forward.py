# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics of all bodies at once."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.tree import Tree
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
