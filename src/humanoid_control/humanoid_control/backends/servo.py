# SPDX-License-Identifier: Apache-2.0
"""First-order servos: joints without inertia that move towards their targets."""

from __future__ import annotations

from collections.abc import Mapping

from humanoid_control.backends.interface import Array, JointTargets
from humanoid_control.limits import JointLimits
from humanoid_description.drives import Drive
import numpy as np


class ServoBank:
    """
    First-order servos of n joints; every array is (n,).

    Without inertia the actuator's kp (position - q) + kd (velocity - dq) balances the damping d dq
    of the joint, so that q approaches its target exponentially at the rate kp / (kd + d), but no
    faster than the limits of velocity and of effort, effort / d, allow. The motion in a period is
    exact for any length of the period.

    Parameters
    ----------
    drives
        The actuator of each of the n joints, by name and in the order of the arrays.
    home_rad
        Joint positions (n,) at the start and after a reset, clipped to the range of the joints.

    Attributes
    ----------
    positions_rad, velocities_rad_s, efforts_nm
        State of the joints (n,); in m, m/s and N if prismatic.

    """

    def __init__(self, drives: Mapping[str, Drive], home_rad: Array) -> None:
        limits = JointLimits.of(drives, tuple(drives))
        gains = [(each.kp, each.kd, each.damping) for each in drives.values()]
        kp, kd, damping = np.array(gains).T
        self._limits = limits
        self._rate_1_s = kp / (kd + damping)
        self._lead_s = kd / kp
        self._damping = damping
        self._fastest_rad_s = np.minimum(limits.velocity_rad_s, limits.effort_nm / damping)
        self._home_rad = np.clip(home_rad, limits.lower_rad, limits.upper_rad)
        self.reset()

    def reset(self) -> None:
        """Reset the joints to their home positions, at rest."""
        rest = np.zeros_like(self._home_rad)
        self.positions_rad = self._home_rad.copy()
        self.velocities_rad_s = rest.copy()
        self.efforts_nm = rest.copy()
        self.aim(JointTargets(self._home_rad, rest, rest))

    def aim(self, targets: JointTargets) -> None:
        """
        Set new targets for all servos.

        Parameters
        ----------
        targets
            Of the n joints, (n,) each. Efforts cause no motion: they count as loads that the
            servos carry.

        """
        self._aim_rad = targets.positions_rad + self._lead_s * targets.velocities_rad_s
        self._load_nm = targets.efforts_nm

    def move(self, period_s: float) -> None:
        """
        Advance all servos towards their targets.

        Parameters
        ----------
        period_s
            Duration of the period.

        """
        limits = self._limits
        left_rad = self._left_after(self._aim_rad - self.positions_rad, period_s)
        free_rad = self._aim_rad - left_rad
        self.positions_rad = np.clip(free_rad, limits.lower_rad, limits.upper_rad)
        fast_rad_s = np.clip(self._rate_1_s * left_rad, -self._fastest_rad_s, self._fastest_rad_s)
        self.velocities_rad_s = np.where(self.positions_rad == free_rad, fast_rad_s, 0.0)
        self.efforts_nm = np.clip(
            self._load_nm + self._damping * self.velocities_rad_s,
            -limits.effort_nm,
            limits.effort_nm,
        )

    def _left_after(self, left_rad: Array, period_s: float) -> Array:
        """Compute the distance to the targets after a period: full speed first, then decaying."""
        distance_rad = np.abs(left_rad)
        beyond_rad = np.maximum(distance_rad - self._fastest_rad_s / self._rate_1_s, 0.0)
        fast_s = np.minimum(beyond_rad / self._fastest_rad_s, period_s)
        distance_rad = distance_rad - self._fastest_rad_s * fast_s
        distance_rad *= np.exp(-self._rate_1_s * (period_s - fast_s))
        after_rad: Array = np.copysign(distance_rad, left_rad)
        return after_rad
