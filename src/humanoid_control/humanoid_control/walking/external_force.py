# SPDX-License-Identifier: Apache-2.0
"""
External force estimation by a momentum observer.

The momentum of the robot changes by the forces at its feet, which are measured, and by those of
other contacts, which are not. A momentum observer estimates the difference without
differentiation: A. De Luca and R. Mattone, "Actuator failure detection and isolation using
generalized momenta", ICRA 2003, here for the linear momentum in the plane.
"""

from __future__ import annotations

from dataclasses import dataclass, field
import math

from humanoid_control.walking.planar import Point


@dataclass
class ForceObserver:
    """Momentum observer of the horizontal external force that does not act on the soles."""

    mass_kg: float
    rate_1_s: float
    """Bandwidth of the estimate."""
    force_n: Point = field(init=False, default=0j)
    """In the axes of the odom frame; against the motion of a robot that walks into an obstacle."""
    _velocity_m_s: Point | None = field(init=False, default=None)

    def update(self, velocity_m_s: Point, ground_n: Point, passed_s: float) -> Point:
        """
        Estimate the horizontal external force with a momentum observer.

        Parameters
        ----------
        velocity_m_s
            Measured velocity of the centre of mass, in the odom frame.
        ground_n
            Measured horizontal force of the ground on the feet, in the axes of the odom frame.
        passed_s
            Time since the last call.

        Returns
        -------
        Point
            Low-pass filtered force in N, in the axes of the odom frame; zero at the first call.

        """
        last, self._velocity_m_s = self._velocity_m_s, velocity_m_s
        if last is not None and passed_s > 0.0:
            change_n = self.mass_kg * (velocity_m_s - last) / passed_s
            share = 1.0 - math.exp(-self.rate_1_s * passed_s)
            self.force_n += share * (change_n - ground_n - self.force_n)
        return self.force_n
