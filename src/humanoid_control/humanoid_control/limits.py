# SPDX-License-Identifier: Apache-2.0
"""Joint limits, and joint targets clamped to them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from humanoid_control.backends import Array, JointTargets
from humanoid_description.drives import Drive
import numpy as np


@dataclass(frozen=True, eq=False)
class JointLimits:
    """Position, velocity and effort limits of n joints (n,); in m, m/s and N if prismatic."""

    lower_rad: Array
    upper_rad: Array
    velocity_rad_s: Array
    effort_nm: Array
    kp_nm_rad: Array
    """Stiffness of the servos: effort per position error."""

    @classmethod
    def of(cls, drives: Mapping[str, Drive], joints: Sequence[str]) -> JointLimits:
        """
        Collect the limits of joints from their actuators.

        Parameters
        ----------
        drives
            The actuator of each joint, by name.
        joints
            Names of the n joints, in the order of the limits.

        """
        columns = [
            (drive.lower, drive.upper, drive.velocity, drive.effort, drive.kp)
            for drive in (drives[joint] for joint in joints)
        ]
        return cls(*np.array(columns, dtype=np.float64).reshape(-1, 5).T.copy())

    def limited(self, targets: JointTargets, last_rad: Array, elapsed_s: float) -> JointTargets:
        """
        Clamp joint targets to the position, velocity and effort limits.

        A position changes by no more than the velocity limit allows in the elapsed time.

        Parameters
        ----------
        targets
            Targets of the n joints.
        last_rad
            Target positions of the previous period (n,).
        elapsed_s
            Time since the previous period.

        """
        way_rad = self.velocity_rad_s * elapsed_s
        position_rad = _between(targets.positions_rad, last_rad - way_rad, last_rad + way_rad)
        return JointTargets(
            _between(position_rad, self.lower_rad, self.upper_rad),
            _between(targets.velocities_rad_s, -self.velocity_rad_s, self.velocity_rad_s),
            _between(targets.efforts_nm, -self.effort_nm, self.effort_nm),
        )


def _between(values: Array, low: Array, high: Array) -> Array:
    """Clamp values; np.clip is several times slower."""
    clipped: Array = np.minimum(np.maximum(values, low), high)
    return clipped
