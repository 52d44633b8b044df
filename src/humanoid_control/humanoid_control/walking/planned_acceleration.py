# SPDX-License-Identifier: Apache-2.0
"""Accelerations of all joints that realise those of the centre of mass and of the soles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.walking.walking_robot import Leg
from humanoid_description.rotations import skew
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_DAMPING = 0.01
"""Fraction of the leg length: keeps accelerations finite where the leg is stretched."""
_ONE: Array = np.eye(6)


@dataclass(frozen=True, eq=False)
class PlannedAcceleration:
    """Planned accelerations, in the axes of the world."""

    com_m_s2: Array
    """(3,) of the centre of mass"""
    turn_rad_s2: Array
    """(3,) angular, of the base"""
    soles: Sequence[Array]
    """(6,) each, left and right: linear, then angular"""
    joints_rad_s2: Array
    """(n,) of the joints that are not in the legs"""


def whole_acceleration(
    state: BodyState, legs: Sequence[LegMap], plan: PlannedAcceleration, limit_rad_s2: float
) -> tuple[Array, Array]:
    """
    Compute the accelerations of root and joints that realise the planned ones.

    The legs follow the soles; the root accelerates so that the centre of mass, including the
    contribution of the legs, gets its planned acceleration.

    Parameters
    ----------
    state
        Measured posture and motion of the robot.
    legs
        Acceleration maps of the legs, left and right.
    plan
        Planned accelerations.
    limit_rad_s2
        Greatest acceleration of a leg joint, to which the results are clamped.

    Returns
    -------
    tuple of Array
        Acceleration of the root (6,), linear in m/s2, then angular in rad/s2, in the axes of the
        world; and accelerations of the joints (n,) in rad/s2.

    """
    base, joints = np.zeros(6), plan.joints_rad_s2.copy()
    base[3:] = plan.turn_rad_s2
    jacobian = state.com_jacobian
    missing = plan.com_m_s2 - state.com_drift_m_s2 - jacobian[:, 3:] @ np.append(base[3:], joints)
    share = np.eye(3)
    without_root = []
    for leg, sole in zip(legs, plan.soles):
        own = jacobian[:, 6 + leg.indices]
        without_root.append(leg.accelerations(sole, base))
        missing -= own @ without_root[-1]
        share -= own @ leg.inverse[:, :3]
    base[:3] = np.linalg.solve(share, missing)
    for leg, alone in zip(legs, without_root):
        followed = alone - leg.inverse[:, :3] @ base[:3]
        joints[leg.indices] = within(followed, limit_rad_s2)
    return base, joints


def within(values: Array, limit: float) -> Array:
    """
    Clip values to plus or minus a limit.

    Parameters
    ----------
    values
        An array of any shape.
    limit
        Greatest magnitude of an element, in the same unit.

    """
    limited: Array = np.minimum(np.maximum(values, -limit), limit)
    return limited


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
