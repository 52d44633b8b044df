# SPDX-License-Identifier: Apache-2.0
"""Reference motion of the centre of mass."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.com_observer import blended
from humanoid_control.walking.pendulum import Motion, Pendulum
from humanoid_control.walking.planar import Point


@dataclass
class ComReference:
    """
    Reference motion of the centre of mass: a pendulum over the commanded zero-moment point.

    It leaks to the measured motion: without that, the integrated motion would diverge from the
    robot.
    """

    pendulum: Pendulum
    leak_1_s: float
    most_distance_m: float
    motion: Motion | None = None

    def update(self, measured: Motion, zmp: Point, passed_s: float) -> Motion:
        """
        Advance the reference motion of the centre of mass by one control period.

        It starts at rest at the estimated position, and stays within `most_distance_m` of it along
        each axis of the odom frame.

        Parameters
        ----------
        measured
            Estimated motion of the centre of mass, in the odom frame.
        zmp
            Commanded zero-moment point (m), in the odom frame.
        passed_s
            Time since the last call.

        Returns
        -------
        Motion
            Reference position in m and velocity in m/s, in the odom frame.

        """
        if self.motion is None:
            self.motion = Motion(measured.position_m)
        driven = self.pendulum.after(self.motion, zmp, passed_s)
        leaked = blended(driven, measured, 1.0 - math.exp(-self.leak_1_s * passed_s))
        lead = leaked.position_m - measured.position_m
        limited = measured.position_m + complex(self._limited(lead.real), self._limited(lead.imag))
        self.motion = Motion(limited, leaked.velocity_m_s)
        return self.motion

    def _limited(self, distance_m: float) -> float:
        """Clamp a distance from the estimate to `most_distance_m`."""
        return max(-self.most_distance_m, min(self.most_distance_m, distance_m))
