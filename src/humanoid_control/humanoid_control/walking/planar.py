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
    """
    Compute the scalar product of two vectors in the plane.

    Parameters
    ----------
    a, b
        The vectors, x + iy.

    """
    return a.real * b.real + a.imag * b.imag


def cross(a: Point, b: Point) -> float:
    """
    Compute the vertical component of the cross product of two vectors in the plane.

    Parameters
    ----------
    a, b
        The vectors, x + iy.

    Returns
    -------
    float
        Positive if the second one points to the left of the first one.

    """
    return a.real * b.imag - a.imag * b.real


def limited(value: float, lower: float, upper: float) -> float:
    """
    Clamp a value to limits.

    Parameters
    ----------
    value
        What is clamped.
    lower, upper
        The limits; the lower one must not be above the upper one.

    """
    return lower if value < lower else upper if value > upper else value


@dataclass(frozen=True)
class PlanarPose:
    """Where something is on the ground, and which way it faces."""

    position_m: Point = 0j
    yaw_rad: float = 0.0

    def at(self, forward_m: float, left_m: float) -> Point:
        """
        Transform a point from the axes of this pose into its frame.

        Parameters
        ----------
        forward_m, left_m
            How far before and to the left of the pose the point lies.

        Returns
        -------
        Point
            In m, in the frame in which the pose is given.

        """
        return self.position_m + complex(forward_m, left_m) * cmath.rect(1.0, self.yaw_rad)

    def local(self, point: Point) -> Point:
        """
        Transform a point into the axes of this pose.

        Parameters
        ----------
        point
            In the frame in which the pose is given (m).

        Returns
        -------
        Point
            How far before (real) and to the left (imaginary) of the pose it lies, in m.

        """
        return self.seen(point - self.position_m)

    def seen(self, vector: Point) -> Point:
        """
        Rotate a vector into the axes of this pose.

        Parameters
        ----------
        vector
            In the axes of the frame in which the pose is given, in any unit.

        Returns
        -------
        Point
            How far ahead (real) and to the left (imaginary) it points, in the same unit.

        """
        return vector * cmath.rect(1.0, -self.yaw_rad)

    def halfway(self, other: PlanarPose) -> PlanarPose:
        """
        Compute the pose in the middle between two.

        Parameters
        ----------
        other
            The other pose, in the same frame.

        Returns
        -------
        PlanarPose
            Its heading halves the shorter turn between the two.

        """
        turn_rad = wrap_angle(other.yaw_rad - self.yaw_rad)
        return PlanarPose((self.position_m + other.position_m) / 2, self.yaw_rad + turn_rad / 2)

    def moved(self, offset_m: Point) -> PlanarPose:
        """
        Shift the pose in the plane, with the same heading.

        Parameters
        ----------
        offset_m
            In the axes of the frame in which the pose is given.

        """
        return PlanarPose(self.position_m + offset_m, self.yaw_rad)
