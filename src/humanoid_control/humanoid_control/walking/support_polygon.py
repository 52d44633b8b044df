# SPDX-License-Identifier: Apache-2.0
"""Support polygon of the feet on the ground, and the supporting area of a sole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.gait_parameters import PostureParameters
from humanoid_control.walking.planar import cross, dot, limited, outwards, PlanarPose, Point
from humanoid_description.geometry import convex_hull, outline
from humanoid_description.kinematics import chain, pose_along
from humanoid_description.robot import Array, Robot
import numpy as np


class SupportPolygon:
    """
    Convex hull of points on the ground.

    Parameters
    ----------
    points
        At least three, not all on a line, in any order and frame (m).

    Raises
    ------
    WalkingError
        The hull has no area.

    """

    def __init__(self, points: Sequence[Point]) -> None:
        hull = convex_hull(np.array([(point.real, point.imag) for point in points]))
        self._corners = [complex(x, y) for x, y in hull]
        if len(self._corners) < 3:
            raise WalkingError(f'{len(points)} points on a line are not a support polygon.')
        self._edges = [
            (start, end - start)
            for start, end in zip(self._corners, self._corners[1:] + self._corners[:1])
        ]

    @property
    def corners(self) -> list[Point]:
        """Return the corners, anticlockwise."""
        return list(self._corners)

    def contains(self, point: Point) -> bool:
        """
        Check whether a point lies inside the polygon or on its edge.

        Parameters
        ----------
        point
            In the frame of the corners (m).

        """
        return all(cross(edge, point - start) >= 0.0 for start, edge in self._edges)

    def clamped(self, point: Point) -> Point:
        """
        Project a point onto the polygon.

        Parameters
        ----------
        point
            In the frame of the corners (m).

        Returns
        -------
        Point
            The closest point of the polygon: the same one if it lies inside.

        """
        if self.contains(point):
            return point
        return min((_on_edge(*edge, point) for edge in self._edges), key=lambda q: abs(q - point))


def _on_edge(start: Point, edge: Point, point: Point) -> Point:
    """Project a point onto an edge."""
    share = dot(point - start, edge) / dot(edge, edge)
    return start + limited(share, 0.0, 1.0) * edge


@dataclass(frozen=True)
class FootShape:
    """Supporting rectangle and planned load point of a left sole; the right one mirrors it."""

    front_m: float
    back_m: float
    outer_m: float
    inner_m: float
    load_m: Point

    @classmethod
    def of(cls, robot: Robot, parameters: PostureParameters) -> FootShape:
        """
        Measure the supporting rectangle of the left sole from the collision shapes of the foot.

        Parameters
        ----------
        robot
            Description of the robot; its link `l_sole` is fixed to the left foot.
        parameters : PostureParameters
            Margins from the edges of the sole, and the offset of the planned load point.

        Returns
        -------
        FootShape
            Rectangle and load point in m, in the frame of the left sole; the right one mirrors it.

        Raises
        ------
        WalkingError
            No link of the foot has a collision shape other than a mesh.

        """
        sole = robot.prefix + 'l_sole'
        way = chain(robot, sole)
        for start in reversed(range(len(way))):
            if way[start].kind != 'fixed':
                break
            foot = robot.link[way[start].parent]
            if foot.collisions:
                in_sole = np.asarray(np.linalg.inv(pose_along(way[start:], {})), np.float64)
                corners = outline(foot.collisions, in_sole)
                if not len(corners):
                    break
                return cls._within(corners.min(axis=0), corners.max(axis=0), parameters)
        raise WalkingError(
            f"'{sole}' has no foot with a collision shape other than a mesh, so its support "
            'polygon is unknown.'
        )

    @classmethod
    def _within(cls, lowest: Array, highest: Array, parameters: PostureParameters) -> FootShape:
        """Build the shape from the extent of the sole, reduced by the margins."""
        return cls(
            float(highest[0]) - parameters.margin_length_m,
            float(lowest[0]) + parameters.margin_length_m,
            float(highest[1]) - parameters.margin_width_m,
            float(lowest[1]) + parameters.margin_width_m,
            complex(parameters.zmp_forward_m, -parameters.zmp_inward_m),
        )

    def load_point(self, side: int, sole: PlanarPose) -> Point:
        """
        Compute the point at which the load of a foot is planned.

        Parameters
        ----------
        side
            Side of the foot.
        sole
            Pose of its sole in the odom frame.

        Returns
        -------
        Point
            Point of the ground in m, in the odom frame.

        """
        return sole.at(self.load_m.real, outwards(side) * self.load_m.imag)

    def corners(self, side: int, sole: PlanarPose) -> list[Point]:
        """
        Compute the corners of the supporting rectangle of a foot.

        Parameters
        ----------
        side
            Side of the foot.
        sole
            Pose of its sole in the odom frame.

        Returns
        -------
        list of Point
            Front outer, front inner, back outer and back inner corner in m, in the odom frame.

        """
        lefts = (outwards(side) * self.outer_m, outwards(side) * self.inner_m)
        return [sole.at(x, y) for x in (self.front_m, self.back_m) for y in lefts]
