# SPDX-License-Identifier: Apache-2.0
"""From any posture to that in which the robot stands, while somebody holds it upright."""

from __future__ import annotations

from humanoid_control.backends import Array, JointTargets
from humanoid_control.walking.parameters import WalkParameters
import numpy as np


class Rising:
    """
    Minimum-jerk motion of the joints to the posture of standing (Flash and Hogan, 1985).

    Parameters
    ----------
    start_rad, home_rad
        Joint positions (n,) at the start, as measured, and in the posture of standing.
    parameters : WalkParameters
        The gait, which has the duration.
    time_s
        Time of the observation at which the motion starts.

    """

    name = 'stand_up'

    def __init__(
        self, start_rad: Array, home_rad: Array, parameters: WalkParameters, time_s: float
    ) -> None:
        self._start_rad, self._way_rad = start_rad.copy(), home_rad - start_rad
        self._duration_s = parameters.fall.stand_up_s
        self._start_s = time_s

    def is_done(self, time_s: float) -> bool:
        """
        Check whether the targets have arrived at the standing posture.

        Parameters
        ----------
        time_s
            The time now, by the same clock as at the start.

        """
        return time_s - self._start_s >= self._duration_s

    def targets(self, time_s: float) -> JointTargets:
        """
        Compute the joint targets of the minimum-jerk motion to the standing posture.

        Parameters
        ----------
        time_s
            The time now, by the same clock as at the start.

        Returns
        -------
        JointTargets
            Of the joints (n,), without efforts.

        """
        t = min(1.0, (time_s - self._start_s) / self._duration_s)
        share = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
        rate_1_s = 30.0 * t**2 * (1.0 - t) ** 2 / self._duration_s
        zeros = np.zeros(len(self._start_rad))
        return JointTargets(
            self._start_rad + share * self._way_rad, rate_1_s * self._way_rad, zeros
        )
