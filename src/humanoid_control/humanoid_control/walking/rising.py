# SPDX-License-Identifier: Apache-2.0
"""Joint motion from any posture to the standing one, while the robot is held upright."""

from __future__ import annotations

from humanoid_control.backends import Array, JointTargets
from humanoid_control.walking.parameters import WalkParameters
import numpy as np


class Rising:
    """
    Minimum-jerk motion of the joints to the standing posture (Flash and Hogan, 1985).

    Parameters
    ----------
    start_rad, home_rad
        Joint positions (n,) at the start, as measured, and in the standing posture.
    parameters : WalkParameters
        Gait parameters, with the duration.
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
            Present time, on the same clock as the start.

        """
        return time_s - self._start_s >= self._duration_s

    def targets(self, time_s: float) -> JointTargets:
        """
        Compute the joint targets of the minimum-jerk motion to the standing posture.

        Parameters
        ----------
        time_s
            Present time, on the same clock as the start.

        Returns
        -------
        JointTargets
            Positions and velocities (n,); efforts are zero.

        """
        t = min(1.0, (time_s - self._start_s) / self._duration_s)
        share = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
        rate_1_s = 30.0 * t**2 * (1.0 - t) ** 2 / self._duration_s
        zeros = np.zeros(len(self._start_rad))
        return JointTargets(
            self._start_rad + share * self._way_rad, rate_1_s * self._way_rad, zeros
        )
