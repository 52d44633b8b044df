# SPDX-License-Identifier: Apache-2.0
"""
Planar geometry: points, vectors, poses and headings in the ground plane.

A point or vector of the plane is a complex number x + iy: the equations of the pendulum are the
same for both axes, and one expression covers both. A rotation is a factor of magnitude one.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass

from humanoid_description.rotations import wrap_angle

Point = complex
"""x + iy; the unit is stated where it is used."""


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
        Value to clamp.
    lower, upper
        Limits; the lower one must not be above the upper one.

    """
    return lower if value < lower else upper if value > upper else value


@dataclass(frozen=True)
class PlanarPose:
    """Pose in the ground plane: position and heading."""

    position_m: Point = 0j
    yaw_rad: float = 0.0

    def at(self, forward_m: float, left_m: float) -> Point:
        """
        Transform a point from the axes of this pose into its frame.

        Parameters
        ----------
        forward_m, left_m
            Coordinates of the point, ahead and to the left of the pose.

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
            Coordinates ahead (real) and to the left (imaginary) of the pose, in m.

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
            Components ahead (real) and to the left (imaginary), in the same unit.

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
            Midpoint; its heading halves the shorter turn between the two.

        """
        turn_rad = wrap_angle(other.yaw_rad - self.yaw_rad)
        return PlanarPose((self.position_m + other.position_m) / 2, self.yaw_rad + turn_rad / 2)

    def moved(self, offset_m: Point) -> PlanarPose:
        """
        Shift the pose in the plane, with the same heading.

        Parameters
        ----------
        offset_m
            Offset in the axes of the frame in which the pose is given.

        """
        return PlanarPose(self.position_m + offset_m, self.yaw_rad)


@dataclass(frozen=True)
class Turning:
    """A heading and its rate."""

    heading_rad: float
    rate_rad_s: float = 0.0


def smooth_turn(from_rad: float, to_rad: float, time_s: float, duration_s: float) -> Turning:
    """
    Interpolate between two headings the short way round, at rest at both ends.

    Parameters
    ----------
    from_rad, to_rad
        Headings at the start and at the end.
    time_s, duration_s
        Time since the start, and duration of the whole turn.

    Returns
    -------
    Turning
        Heading and rate at that time; constant after the end.

    """
    turn_rad, share = wrap_angle(to_rad - from_rad), min(1.0, time_s / duration_s)
    return Turning(
        from_rad + turn_rad * share**2 * (3.0 - 2.0 * share),
        turn_rad * 6.0 * share * (1.0 - share) / duration_s,
    )
