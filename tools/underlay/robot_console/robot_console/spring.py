# SPDX-License-Identifier: Apache-2.0
"""The spring with which the pointer pulls an object: its two ends, and its force."""

from __future__ import annotations

from dataclasses import dataclass
import math

from rviz_common.frames import Pose
from rviz_common.selection import Point, Ray

__all__ = ['Grip', 'Spring']


@dataclass(frozen=True)
class Spring:
    """A spring without damping, whose force is limited."""

    stiffness_n_m: float
    limit_n: float

    def force(self, grip: Point, pointer: Point) -> Point:
        """
        Compute the force on the object.

        Parameters
        ----------
        grip, pointer
            The end at the object, and the end that it is pulled to, in m.

        Returns
        -------
        Point
            The force in N, towards the pointer; at most as strong as the limit.

        """
        stretch = math.dist(grip, pointer)
        if stretch * self.stiffness_n_m <= self.limit_n:
            factor = self.stiffness_n_m
        else:
            factor = self.limit_n / stretch
        x, y, z = (factor * (b - a) for a, b in zip(grip, pointer))
        return x, y, z


@dataclass(frozen=True)
class Grip:
    """
    A point of an object that the pointer has gripped.

    The pointer moves in a plane across the view, through the point where it gripped the object.
    """

    local: Point
    """The point in the frame of the object, in m."""
    at: Point
    """Where it was gripped, in m in the fixed frame."""
    normal: Point
    """The direction of view at that time, of length 1."""

    @classmethod
    def on(cls, ray: Ray, distance: float, pose: Pose) -> Grip:
        """
        Grip an object.

        Parameters
        ----------
        ray
            From the eye through the pointer, with a direction of length 1.
        distance
            Where the ray meets the object, in m.
        pose
            The pose of the object in the frame of the ray.

        """
        at = ray.at(distance)
        return cls(pose.inverse().of(Pose(at)).position, at, ray.direction)

    def point(self, pose: Pose) -> Point:
        """
        Compute where the gripped point is now.

        Parameters
        ----------
        pose
            The pose of the object.

        """
        return pose.of(Pose(self.local)).position

    def pointer(self, ray: Ray) -> Point | None:
        """
        Compute where the pointer pulls to.

        Parameters
        ----------
        ray
            From the eye through the pointer.

        Returns
        -------
        Point | None
            None if the pointer is beside everything in view of the grip, as after the view has
            been turned.

        """
        ahead = _dot(ray.direction, self.normal)
        if ahead < LEAST_AHEAD:
            return None
        distance = _dot([a - b for a, b in zip(self.at, ray.origin)], self.normal) / ahead
        return ray.at(distance) if distance > 0.0 else None


LEAST_AHEAD = 0.1
"""The cosine of the largest angle between the views while pulling."""


def _dot(left: list[float] | Point, right: list[float] | Point) -> float:
    return sum(a * b for a, b in zip(left, right))
