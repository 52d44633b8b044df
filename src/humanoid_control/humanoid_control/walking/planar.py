# SPDX-License-Identifier: Apache-2.0
"""
The ground plane, in which most of walking happens.

A point or vector of the plane is a complex number x + iy: the pendulum's equations hold for both
axes alike, and one line of arithmetic serves them at once. A turn is a factor of length one.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass

from humanoid_control.dynamics.rotations import wrap_angle

Point = complex
"""x + iy; the unit is said where it is used."""


def dot(a: Point, b: Point) -> float:
    """Return the scalar product of two vectors."""
    return a.real * b.real + a.imag * b.imag


def cross(a: Point, b: Point) -> float:
    """Return the vertical component of the cross product of two vectors."""
    return a.real * b.imag - a.imag * b.real


def limited(value: float, lower: float, upper: float) -> float:
    """Return the value within limits closest to a value."""
    return lower if value < lower else upper if value > upper else value


@dataclass(frozen=True)
class PlanarPose:
    """Where something is on the ground, and which way it faces."""

    position_m: Point = 0j
    yaw_rad: float = 0.0

    def at(self, forward_m: float, left_m: float) -> Point:
        """Return the point of the plane that lies so far before and to the left of the pose."""
        return self.position_m + complex(forward_m, left_m) * cmath.rect(1.0, self.yaw_rad)

    def local(self, point: Point) -> Point:
        """Return how far before (real) and to the left (imaginary) of the pose a point lies."""
        return self.seen(point - self.position_m)

    def seen(self, vector: Point) -> Point:
        """Return how far ahead (real) and to the left (imaginary) a vector points."""
        return vector * cmath.rect(1.0, -self.yaw_rad)

    def halfway(self, other: PlanarPose) -> PlanarPose:
        """Return the pose in the middle between two."""
        turn_rad = wrap_angle(other.yaw_rad - self.yaw_rad)
        return PlanarPose((self.position_m + other.position_m) / 2, self.yaw_rad + turn_rad / 2)

    def moved(self, offset_m: Point) -> PlanarPose:
        """Return the pose shifted in the plane."""
        return PlanarPose(self.position_m + offset_m, self.yaw_rad)
