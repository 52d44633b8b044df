# SPDX-License-Identifier: Apache-2.0
"""Joint accelerations of a leg for an acceleration of its sole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.dynamics import BodyState
from humanoid_control.dynamics.rotations import skew
from humanoid_control.walking.walking_robot import Leg
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_DAMPING = 0.01
"""Fraction of the leg length: keeps accelerations finite where the leg is stretched."""
_ONE: Array = np.eye(6)


@dataclass(frozen=True, eq=False)
class LegMap:
    """
    Map from the accelerations of sole and base to those of the joints of a leg.

    Accelerations of sole and base are (6,): linear, then angular, in the axes of the world.
    """

    indices: NDArray[np.intp]
    inverse: Array
    """(6, 6)"""
    carry: Array
    """(6, 6) map from the acceleration of the base to that of a sole fixed to it"""
    drift: Array
    """(6,) acceleration bias of the sole: at zero acceleration of base and joints"""

    def accelerations(self, sole: Array, base: Array) -> Array:
        """
        Compute the joint accelerations of the leg for given accelerations of sole and base.

        Parameters
        ----------
        sole, base
            Accelerations (6,): linear in m/s2, then angular in rad/s2, in the axes of the world.

        Returns
        -------
        Array
            Accelerations (6,) of the joints in rad/s2, from the hip down.

        """
        accelerations: Array = self.inverse @ (sole - self.drift - self.carry @ base)
        return accelerations


def leg_maps(legs: Sequence[Leg], state: BodyState) -> list[LegMap]:
    """
    Compute the acceleration maps of legs by damped least squares.

    Parameters
    ----------
    legs
        The legs, in the order of the result.
    state
        Measured posture and motion of the robot.

    Returns
    -------
    list of LegMap
        One for each leg.

    """
    jacobians = np.array([state.jacobian_of(leg.group, leg.sole) for leg in legs])
    turned = jacobians.transpose(0, 2, 1)
    damping = np.array([(_DAMPING * leg.geometry.length_m) ** 2 for leg in legs])
    # Damped least squares (Nakamura and Hanafusa, Inverse kinematic solutions with singularity
    # robustness, ASME Journal of Dynamic Systems 108, 1986).
    squares = turned @ jacobians + damping[:, None, None] * _ONE
    inverses = np.linalg.solve(squares, turned)
    return [_leg_map(leg, state, inverse) for leg, inverse in zip(legs, inverses)]


def _leg_map(leg: Leg, state: BodyState, inverse: Array) -> LegMap:
    """Build the acceleration map of a leg."""
    carry = _ONE.copy()
    carry[:3, 3:] = -skew(state.position_m(leg.sole))
    return LegMap(leg.indices, inverse, carry, state.drift(leg.sole))
