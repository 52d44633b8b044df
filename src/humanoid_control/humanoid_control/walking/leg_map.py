# SPDX-License-Identifier: Apache-2.0
"""How the joints of a leg accelerate for an acceleration of its sole."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.rotations import skew
from humanoid_control.walking.walking_robot import Leg
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_DIAGONAL = np.diag_indices(6)
_DAMPING = 0.01
"""As a share of the leg's length: keeps rates finite where the leg is stretched."""


@dataclass(frozen=True, eq=False)
class LegMap:
    """
    The map from accelerations of sole and base to those of the leg's joints.

    Those of sole and base are (6,): linear, then angular, in the axes of the world.
    """

    indices: NDArray[np.intp]
    inverse: Array
    """(6, 6)"""
    carry: Array
    """(6, 6) how the sole goes with the base"""
    drift: Array
    """(6,) the acceleration of the sole while base and joints do not accelerate"""

    @classmethod
    def of(cls, leg: Leg, state: BodyState) -> LegMap:
        """Return the map of a leg in the posture that is measured."""
        own = state.jacobian_of(leg.group, leg.sole)
        carry = np.eye(6)
        carry[:3, 3:] = -skew(state.position_m(leg.sole))
        # Damped least squares (Nakamura and Hanafusa, Inverse kinematic solutions with
        # singularity robustness, ASME Journal of Dynamic Systems 108, 1986).
        square = own.T @ own
        square[_DIAGONAL] += (_DAMPING * leg.geometry.length_m) ** 2
        inverse = np.linalg.solve(square, own.T)
        return cls(leg.indices, inverse, carry, state.drift(leg.sole))

    def accelerations(self, sole: Array, base: Array) -> Array:
        """Return how the joints accelerate (6,) for accelerations of sole and base."""
        accelerations: Array = self.inverse @ (sole - self.drift - self.carry @ base)
        return accelerations
