# SPDX-License-Identifier: Apache-2.0
"""Change the owner of a joint without a jump."""

from __future__ import annotations

from humanoid_control.backends import Array, JointTargets
from humanoid_control.controllers.interface import Mask
import numpy as np

BLEND_S = 0.5


class Blend:
    """
    Offset that fades from the last targets of joints to those of their new owner.

    It begins with the difference of position and velocity and ends with none, along the
    polynomial of least jerk between the two (Flash and Hogan, 1985).

    Parameters
    ----------
    joints
        How many joints the robot has, n.
    duration_s
        Time from a change of the owner until the offset is zero.

    """

    def __init__(self, joints: int, duration_s: float = BLEND_S) -> None:
        self._duration_s = duration_s
        self._since_s = np.full(joints, -np.inf)
        self._until_s = -np.inf
        self._offset_rad, self._speed_rad_s, self._effort_nm = np.zeros((3, joints))

    def begin(self, joints: Mask, now_s: float, last: JointTargets, new: JointTargets) -> None:
        """
        Start to blend some joints from their old targets to those of their new owner.

        Parameters
        ----------
        joints
            Mask (n,) of the joints that change their owner.
        now_s
            The robot's time.
        last, new
            Targets of all n joints at this moment: those that the old owner leaves, and those that
            the new owner gives.

        """
        self._since_s[joints] = now_s
        self._until_s = now_s + self._duration_s
        self._offset_rad[joints] = (last.positions_rad - new.positions_rad)[joints]
        self._speed_rad_s[joints] = (last.velocities_rad_s - new.velocities_rad_s)[joints]
        self._effort_nm[joints] = (last.efforts_nm - new.efforts_nm)[joints]

    def blended(self, now_s: float, new: JointTargets) -> JointTargets:
        """
        Add what is left of the offset to the targets of a moment.

        Parameters
        ----------
        now_s
            The robot's time.
        new
            What the present owners ask of all n joints.

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
        """Return the offset, its derivative, and the share that is left, of a share of time."""
        left = 1.0 - passed
        share = left**3 * (1.0 + 3.0 * passed + 6.0 * passed**2)
        share_rate = -30.0 * (passed * left) ** 2 / self._duration_s
        slope = passed * left**3 * (1.0 + 3.0 * passed)
        slope_rate = left**2 * (1.0 + 2.0 * passed - 15.0 * passed**2)
        offset_rad = share * self._offset_rad + slope * self._duration_s * self._speed_rad_s
        speed_rad_s = share_rate * self._offset_rad + slope_rate * self._speed_rad_s
        return offset_rad, speed_rad_s, share
