# SPDX-License-Identifier: Apache-2.0
"""Footholds of the feet, with load points, support polygons and loads, and the ground reaction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.walking.planar import (
    dot,
    GroundPlane,
    LEFT,
    LEVEL,
    limited,
    PlanarPose,
    Point,
    RIGHT,
    SIDES,
)
from humanoid_control.walking.support_polygon import FootShape, SupportPolygon
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Foothold:
    """Foothold: the pose of a sole on the ground, and the ground plane below it."""

    pose: PlanarPose
    plane: GroundPlane = LEVEL

    @property
    def sole_m(self) -> Array:
        """Return the position (3,) of the origin of the sole."""
        point = self.pose.position_m
        return np.array([point.real, point.imag, self.plane.height_m])


@dataclass(frozen=True)
class SoleReading:
    """Measured pose and load of a sole."""

    pose: PlanarPose
    plane: GroundPlane
    load: float
    """Normal force on it, as a fraction of the weight of the robot."""
    drag: Point = 0j
    """Horizontal force on it, as a fraction of the weight of the robot."""


class Footing:
    """
    Present or last footholds of both feet, with their load points and support polygons.

    Parameters
    ----------
    shape
        Supporting rectangle of a sole, and its planned load point.
    footholds
        Footholds of the left and the right foot, in the odom frame.

    """

    def __init__(self, shape: FootShape, footholds: Sequence[Foothold]) -> None:
        self._shape = shape
        self._footholds = list(footholds)
        self._polygons: dict[tuple[int, ...], SupportPolygon] = {}

    def __getitem__(self, side: int) -> Foothold:
        """Return the foothold of a foot."""
        return self._footholds[side]

    def put(self, side: int, foothold: Foothold) -> None:
        """
        Replace the foothold of a foot, for example after its landing.

        Parameters
        ----------
        side
            Side of the foot.
        foothold
            New foothold, in the odom frame.

        """
        self._footholds[side] = foothold
        self._polygons.clear()

    def pose(self, side: int) -> PlanarPose:
        """
        Return the pose of a foothold in the plane of the odom frame.

        Parameters
        ----------
        side
            Side of the foot.

        """
        return self._footholds[side].pose

    def adapt(self, side: int, foothold: Foothold) -> None:
        """
        Adapt the height and tilt of a foothold that keeps its pose in the plane.

        Parameters
        ----------
        side
            Side of the foot.
        foothold
            Adapted foothold in the odom frame. Its pose must be the present one, since the support
            polygon is not computed again.

        """
        self._footholds[side] = foothold

    def height_m(self, shares: tuple[float, float]) -> float:
        """
        Compute the mean height of the footholds, weighted by the load on the feet.

        Parameters
        ----------
        shares
            Load distribution, left and right; the sum is 1.

        Returns
        -------
        float
            Height in m, in the odom frame.

        """
        left, right = self._footholds
        return shares[LEFT] * left.plane.height_m + shares[RIGHT] * right.plane.height_m

    @property
    def middle(self) -> PlanarPose:
        """Return the pose in the middle between the feet."""
        return self.pose(LEFT).halfway(self.pose(RIGHT))

    @property
    def tilt(self) -> Point:
        """Return the mean tilt of the ground below the feet."""
        left, right = self._footholds
        return (left.plane.tilt + right.plane.tilt) / 2

    def load_point(self, side: int, pose: PlanarPose | None = None) -> Point:
        """
        Compute the point at which the load of a foot is planned.

        Parameters
        ----------
        side
            Side of the foot.
        pose
            Pose of its sole in the odom frame; by default that of its foothold.

        Returns
        -------
        Point
            Point of the ground in m, in the odom frame.

        """
        return self._shape.load_point(side, pose or self.pose(side))

    @property
    def rest_point(self) -> Point:
        """Return the rest point of the load: the middle between the load points of both feet."""
        return (self.load_point(LEFT) + self.load_point(RIGHT)) / 2

    def polygon(self, sides: Sequence[int] = SIDES) -> SupportPolygon:
        """
        Compute the support polygon of the feet on the ground.

        Parameters
        ----------
        sides
            Sides of the feet that carry the robot; both by default.

        Returns
        -------
        SupportPolygon
            Convex hull of the supporting rectangles of these feet, in the odom frame.

        """
        key = tuple(sides)
        if key not in self._polygons:
            self._polygons[key] = SupportPolygon(
                [corner for side in key for corner in self._shape.corners(side, self.pose(side))]
            )
        return self._polygons[key]


@dataclass(frozen=True)
class Loads:
    """Load distribution over the feet, and the centre of pressure under each."""

    shares: tuple[float, float]
    points_m: tuple[Point, Point]


def loads_for(footing: Footing, sides: Sequence[int], zmp: Point) -> Loads:
    """
    Compute the load distribution of the feet for a zero-moment point.

    On both feet the shares follow from the projection of the point onto the line between the load
    points; the rest of its offset moves the centres of pressure of both feet alike.

    Parameters
    ----------
    footing
        Footholds of both feet, in the odom frame.
    sides
        Sides of the feet that carry the robot: one or both.
    zmp
        Zero-moment point (m) in the odom frame.

    Returns
    -------
    Loads
        Shares, which sum to 1, and centres of pressure in m, in the odom frame.

    """
    if len(sides) == 1:
        return Loads((1.0, 0.0) if sides[0] == LEFT else (0.0, 1.0), (zmp, zmp))
    left = footing.load_point(LEFT)
    line = footing.load_point(RIGHT) - left
    share = limited(dot(zmp - left, line) / dot(line, line), 0.0, 1.0)
    aside = zmp - (left + share * line)
    return Loads((1.0 - share, share), (left + aside, left + line + aside))


@dataclass(frozen=True, eq=False)
class GroundReaction:
    """Ground reaction: a force (3,) at a point of the ground, and a torque about the vertical."""

    force_n: Array
    point_m: Point
    turn_nm: float

    @classmethod
    def of(cls, wrench: Array, base_m: Array) -> GroundReaction:
        """
        Compute the ground reaction that is equivalent to a wrench on the base.

        The force acts at the centre of pressure, where the ground exerts a torque only about the
        vertical.

        Parameters
        ----------
        wrench
            Force (N) and torque (N m) at the origin of base_link (6,), in the axes of odom.
        base_m
            Origin of base_link (3,): x and y in the odom frame, z above the ground.

        Returns
        -------
        GroundReaction
            Its point is in the odom frame.

        """
        x, y, z, about_x, about_y, about_z = wrench.tolist()
        down_m = -float(base_m[2])
        from_base = complex(down_m * x - about_y, down_m * y + about_x) / z
        turn_nm = about_z - (from_base.real * y - from_base.imag * x)
        return cls(wrench[:3], complex(base_m[0], base_m[1]) + from_base, turn_nm)

    def within(self, polygon: SupportPolygon, most_turn_nm: float) -> GroundReaction:
        """
        Clamp the reaction to what the feet on the ground can exert.

        The force is kept; its point moves into the support polygon. The torque that is missing
        rotates the robot, but does not move its centre of mass.

        Parameters
        ----------
        polygon
            Support polygon of the feet on the ground, in the odom frame.
        most_turn_nm
            Greatest torque about the vertical, in N m.

        """
        turn_nm = limited(self.turn_nm, -most_turn_nm, most_turn_nm)
        return GroundReaction(self.force_n, polygon.clamped(self.point_m), turn_nm)
