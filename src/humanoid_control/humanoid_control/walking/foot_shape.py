# SPDX-License-Identifier: Apache-2.0
"""Supporting area of the soles of the feet."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.sides import outwards
from humanoid_description.geometry import outline
from humanoid_description.kinematics import chain, pose_along
from humanoid_description.robot import Array, Robot
import numpy as np


@dataclass(frozen=True)
class FootShape:
    """Supporting rectangle and planned load point of a left sole; the right one mirrors it."""

    front_m: float
    back_m: float
    outer_m: float
    inner_m: float
    load_m: Point

    @classmethod
    def of(cls, robot: Robot, parameters: WalkParameters) -> FootShape:
        """
        Measure the supporting rectangle of the left sole from the collision shapes of the foot.

        Parameters
        ----------
        robot
            Description of the robot; its link `l_sole` is fixed to the left foot.
        parameters : WalkParameters
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
            f"'{sole}' has no foot with a collision shape that is no mesh: nobody can tell where "
            'it may stand.'
        )

    @classmethod
    def _within(cls, lowest: Array, highest: Array, parameters: WalkParameters) -> FootShape:
        """Build the shape from the extent of the sole, reduced by the margins."""
        return cls(
            float(highest[0]) - parameters.posture.margin_length_m,
            float(lowest[0]) + parameters.posture.margin_length_m,
            float(highest[1]) - parameters.posture.margin_width_m,
            float(lowest[1]) + parameters.posture.margin_width_m,
            complex(parameters.posture.zmp_forward_m, -parameters.posture.zmp_inward_m),
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
