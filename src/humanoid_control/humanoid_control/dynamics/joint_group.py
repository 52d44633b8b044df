# SPDX-License-Identifier: Apache-2.0
"""Groups of joints, with precomputed tables for their inertia matrix."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
