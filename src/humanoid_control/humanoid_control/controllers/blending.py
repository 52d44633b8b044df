# SPDX-License-Identifier: Apache-2.0
"""Bumpless transfer of joints from one controller to another."""

from __future__ import annotations

from humanoid_control.backends import Array, JointTargets
from humanoid_control.controllers.interface import Mask
import numpy as np

BLEND_S = 0.5


class Blend:
    """
    Offset that blends the targets of joints from those of their old controller to the new ones.

    It starts at the difference in position and velocity and decays to zero along the minimum-jerk
    polynomial (Flash and Hogan, 1985).

    Parameters
    ----------
    joints
        Number of joints of the robot, n.
    duration_s
        Time from a change of controller until the offset is zero.

    """

    def __init__(self, joints: int, duration_s: float = BLEND_S) -> None:
        self._duration_s = duration_s
        self._since_s = np.full(joints, -np.inf)
        self._until_s = -np.inf
        self._offset_rad, self._speed_rad_s, self._effort_nm = np.zeros((3, joints))

    def begin(self, joints: Mask, now_s: float, last: JointTargets, new: JointTargets) -> None:
        """
        Start blending joints from their old targets to those of their new controller.

        Parameters
        ----------
        joints
            Mask (n,) of the joints whose controller changes.
        now_s
            The robot's time.
        last, new
            Targets of all n joints at this moment: those of the old and those of the new
            controllers.

        """
        self._since_s[joints] = now_s
        self._until_s = now_s + self._duration_s
        self._offset_rad[joints] = (last.positions_rad - new.positions_rad)[joints]
        self._speed_rad_s[joints] = (last.velocities_rad_s - new.velocities_rad_s)[joints]
        self._effort_nm[joints] = (last.efforts_nm - new.efforts_nm)[joints]

    def blended(self, now_s: float, new: JointTargets) -> JointTargets:
        """
        Add the remaining offset to the current targets.

        Parameters
        ----------
        now_s
            The robot's time.
        new
            Targets of all n joints from their current controllers.

        Returns
        -------
        JointTargets
            Blended targets of all n joints; `new` itself when no blend is under way.

        """
        if now_s >= self._until_s:
            return new
        passed = np.minimum((now_s - self._since_s) / self._duration_s, 1.0)
        offset_rad, speed_rad_s, share = self._left(passed)
        return JointTargets(
            new.positions_rad + offset_rad,
            new.velocities_rad_s + speed_rad_s,
            new.efforts_nm + share * self._effort_nm,
        )

    def _left(self, passed: Array) -> tuple[Array, Array, Array]:
        """Compute the offset, its derivative and its weight at a fraction of the blend time."""
        left = 1.0 - passed
        share = left**3 * (1.0 + 3.0 * passed + 6.0 * passed**2)
        share_rate = -30.0 * (passed * left) ** 2 / self._duration_s
        slope = passed * left**3 * (1.0 + 3.0 * passed)
        slope_rate = left**2 * (1.0 + 2.0 * passed - 15.0 * passed**2)
        offset_rad = share * self._offset_rad + slope * self._duration_s * self._speed_rad_s
        speed_rad_s = share_rate * self._offset_rad + slope_rate * self._speed_rad_s
        return offset_rad, speed_rad_s, share
