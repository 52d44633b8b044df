# SPDX-License-Identifier: Apache-2.0
"""The accelerations of the whole robot that follow from what is planned."""

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
    """What is planned, in the axes of the world."""

    com_m_s2: Array
    """(3,)"""
    turn_rad_s2: Array
    """(3,) of the base"""
    soles: Sequence[Array]
    """(6,) each, left and right: linear, then angular"""
    joints_rad_s2: Array
    """(n,) of the joints that are not in the legs"""


def whole_acceleration(
    state: BodyState, legs: Sequence[LegMap], plan: PlannedAcceleration, limit_rad_s2: float
) -> tuple[Array, Array]:
    """
    Compute the accelerations of root and joints that realise the planned ones.

    The legs follow the soles; the root moves so that the centre of mass, to which the legs in
    the air add their part, gets its acceleration.

    Parameters
    ----------
    state
        The measured posture and motion of the robot.
    legs
        The acceleration maps of the legs, left and right.
    plan
        What is planned.
    limit_rad_s2
        The greatest acceleration of a joint in the legs; they get no more.

    Returns
    -------
    tuple of Array
        The acceleration of the root (6,), linear in m/s2, then angular in rad/s2, in the axes of
        the world; and those of the joints (n,) in rad/s2.

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
        The greatest magnitude of an entry, in the same unit.

    """
    limited: Array = np.minimum(np.maximum(values, -limit), limit)
    return limited
