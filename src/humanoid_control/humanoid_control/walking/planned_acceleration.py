# SPDX-License-Identifier: Apache-2.0
"""Whole-body accelerations that realise the planned ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.dynamics import BodyState
from humanoid_control.walking.leg_map import LegMap
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
