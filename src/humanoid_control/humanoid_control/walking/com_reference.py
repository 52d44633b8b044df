# SPDX-License-Identifier: Apache-2.0
"""Where the centre of mass is to go."""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.com_observer import blended
from humanoid_control.walking.pendulum import Motion, Pendulum
from humanoid_control.walking.planar import Point


@dataclass
class ComReference:
    """
    The motion of a pendulum over the commanded zero-moment point.

    It leaks to the measured motion: integrated alone it would run away from the robot.
    """

    pendulum: Pendulum
    leak_1_s: float
    most_distance_m: float
    motion: Motion | None = None

    def update(self, measured: Motion, zmp: Point, passed_s: float) -> Motion:
        """Return the motion wanted now; it begins at rest where the robot is."""
        if self.motion is None:
            self.motion = Motion(measured.position_m)
        driven = self.pendulum.after(self.motion, zmp, passed_s)
        leaked = blended(driven, measured, 1.0 - math.exp(-self.leak_1_s * passed_s))
        lead = leaked.position_m - measured.position_m
        limited = measured.position_m + complex(self._limited(lead.real), self._limited(lead.imag))
        self.motion = Motion(limited, leaked.velocity_m_s)
        return self.motion

    def _limited(self, distance_m: float) -> float:
        """Keep a distance from the robot small."""
        return max(-self.most_distance_m, min(self.most_distance_m, distance_m))
