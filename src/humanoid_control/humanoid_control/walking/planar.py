# SPDX-License-Identifier: Apache-2.0
"""
Planar geometry: points, poses and headings in the ground plane, the sides, planes below the feet.

A point or vector of the plane is a complex number x + iy: the equations of the pendulum are the
same for both axes, and one expression covers both. A rotation is a factor of magnitude one. The
sides are indices of pairs, left first, as in observations.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass
import math

from humanoid_description.rotations import about_z, wrap_angle
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Point = complex
"""x + iy; the unit is stated where it is used."""
LEFT, RIGHT = 0, 1
SIDES = (LEFT, RIGHT)
NAMES = ('left', 'right')


def other(side: int) -> int:
    """
    Get the opposite side.

    Parameters
    ----------
    side
        `LEFT` or `RIGHT`.

    """
    return 1 - side


def outwards(side: int) -> float:
    """
    Get the direction away from the body along y.

    Parameters
    ----------
    side
        `LEFT` or `RIGHT`.

    Returns
    -------
    float
        1 for the left side, -1 for the right one.

    """
    return 1.0 if side == LEFT else -1.0


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


@dataclass(frozen=True)
class GroundPlane:
    """Ground plane below a foot, or the plane of a sole."""

    height_m: float = 0.0
    """Height of the origin of a sole that stands on it."""
    tilt: Point = 0j
    """Horizontal part of its unit normal, which points downhill."""

    def rotation(self, yaw_rad: float) -> Array:
        """
        Compute the rotation of a sole that stands flat on the plane.

        Parameters
        ----------
        yaw_rad
            Heading of the sole before it is tilted, in the odom frame.

        Returns
        -------
        Array
            Rotation matrix (3, 3) from the sole to the odom frame.

        """
        x, y = self.tilt.real, self.tilt.imag
        z = math.sqrt(max(0.0, 1.0 - x * x - y * y))
        k = 1.0 / (1.0 + z)
        # The shortest rotation from the vertical to the normal (Rodrigues).
        leaning = np.array(
            [[1.0 - k * x * x, -k * x * y, x], [-k * x * y, 1.0 - k * y * y, y], [-x, -y, z]]
        )
        rotation: Array = leaning @ about_z(yaw_rad)
        return rotation

    def height_beside(self, offset_m: Point, tilt: Point) -> float:
        """
        Extrapolate the height of the ground to a point beside the plane's origin.

        Parameters
        ----------
        offset_m
            Horizontal offset of the point, in the axes of the odom frame.
        tilt
            Tilt of the ground between the two, as `GroundPlane.tilt`.

        Returns
        -------
        float
            Height in m, with the same zero as that of the plane.

        """
        return self.height_m - dot(tilt, offset_m)


LEVEL = GroundPlane()


def tilt_of(rotation: Array, most_rad: float) -> Point:
    """
    Compute the tilt of a sole, clamped to the maximum slope of the ground.

    Parameters
    ----------
    rotation
        Rotation matrix (3, 3) from the sole to the odom frame.
    most_rad
        Greatest angle between the sole and the horizontal.

    Returns
    -------
    Point
        As `GroundPlane.tilt`, in the axes of the odom frame.

    """
    tilt = complex(rotation[0, 2], rotation[1, 2])
    size = abs(tilt)
    return tilt * min(1.0, math.sin(most_rad) / size) if size > 0.0 else tilt
