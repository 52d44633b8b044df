# SPDX-License-Identifier: Apache-2.0
"""
The linear inverted pendulum: the centre of mass at constant height above the zero-moment point.

S. Kajita et al., "The 3D linear inverted pendulum mode", IROS 2001, and the divergent component
of motion of T. Takenaka et al., IROS 2009 (the capture point): with c'' = w^2 (c - p) the point
xi = c + c'/w diverges from p as exp(w t), while c converges to xi by itself.
"""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.walking.planar import Point

GRAVITY_M_S2 = 9.81


@dataclass(frozen=True)
class Motion:
    """Horizontal position and velocity of the centre of mass."""

    position_m: Point = 0j
    velocity_m_s: Point = 0j


@dataclass(frozen=True)
class Pendulum:
    """Linear inverted pendulum of constant height."""

    height_m: float

    @property
    def rate_1_s(self) -> float:
        """Return w = sqrt(g / h), the rate at which the pendulum diverges."""
        return math.sqrt(GRAVITY_M_S2 / self.height_m)

    def dcm(self, motion: Motion) -> Point:
        """
        Compute the divergent component of motion (DCM, or capture point).

        Parameters
        ----------
        motion
            Position and velocity of the centre of mass over the ground.

        Returns
        -------
        Point
            In m, in the plane and the frame of the motion.

        """
        return motion.position_m + motion.velocity_m_s / self.rate_1_s

    def after(self, motion: Motion, zmp: Point, time_s: float) -> Motion:
        """
        Predict the motion of the centre of mass over a constant zero-moment point.

        The solution is exact, for any time.

        Parameters
        ----------
        motion
            Position and velocity of the centre of mass now.
        zmp
            The zero-moment point, in the frame of the motion (m).
        time_s
            How far ahead to predict.

        """
        rate = self.rate_1_s
        cosh, sinh = math.cosh(rate * time_s), math.sinh(rate * time_s)
        lean = motion.position_m - zmp
        return Motion(
            zmp + lean * cosh + motion.velocity_m_s * (sinh / rate),
            lean * (rate * sinh) + motion.velocity_m_s * cosh,
        )

    def acceleration_m_s2(self, position: Point, zmp: Point) -> Point:
        """
        Compute the horizontal acceleration of the centre of mass over a zero-moment point.

        Parameters
        ----------
        position, zmp
            The centre of mass and the zero-moment point in the ground plane (m).

        Returns
        -------
        Point
            The acceleration in m/s2, in the same axes.

        """
        return (position - zmp) * (GRAVITY_M_S2 / self.height_m)
