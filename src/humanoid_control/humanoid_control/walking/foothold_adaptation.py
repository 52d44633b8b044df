# SPDX-License-Identifier: Apache-2.0
"""Adaptation of the feet to the ground: measured soles, and the footholds that follow them."""

from __future__ import annotations

from dataclasses import replace
import math

from humanoid_control.walking.footing import Foothold, Footing, SoleReading
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.sides import LEFT, RIGHT, SIDES
from humanoid_control.walking.state_estimator import RobotState
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.terrain import GroundPlane, tilt_of
from humanoid_control.walking.walking_robot import WalkingRobot
from humanoid_description.rotations import yaw_of
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class FootholdAdaptation:
    """
    Foothold adaptation: moves footholds to the tilt and the height at which soles come to rest.

    A sole that lands tilted is rotated by the ground until it lies flat. Its target follows the
    measurement, the faster the more weight it carries: the ankle then has no stiffness against the
    ground, and the joint torques alone determine the centre of pressure. A sole in the air is not
    adapted. A foot that has touched the ground but carries too little load is pressed down.

    Parameters
    ----------
    parameters : WalkParameters
        Gait parameters, with the rates and the load thresholds of the adaptation.

    """

    def __init__(self, parameters: WalkParameters) -> None:
        self._parameters = parameters
        self._since_s = [0.0, 0.0]

    def update(
        self,
        footing: Footing,
        soles: tuple[SoleReading, SoleReading],
        shares: tuple[float, float],
        in_air: int | None,
        passed_s: float,
    ) -> None:
        """
        Adapt the footholds to the measured tilt and height of the ground.

        Parameters
        ----------
        footing
            Footholds in the odom frame; those of the feet on the ground are updated.
        soles
            Measured poses and loads of the soles, left and right, in the odom frame.
        shares
            Commanded load distribution, left and right; the sum is 1.
        in_air
            Side of the swing foot, which is not adapted; None if both feet are on the ground.
        passed_s
            Time since the last call.

        """
        for side in SIDES:
            if side == in_air:
                self._since_s[side] = 0.0
                continue
            self._since_s[side] += passed_s
            plane = self._plane(side, footing[side].plane, soles[side], shares[side], passed_s)
            footing.adapt(side, Foothold(footing.pose(side), plane))

    def _plane(
        self, side: int, told: GroundPlane, sole: SoleReading, share: float, passed_s: float
    ) -> GroundPlane:
        """Compute the adapted ground plane of a foothold."""
        p, height_m = self._parameters, told.height_m
        if share <= 0.0 and sole.load < p.swing.touchdown_load:
            height_m -= p.terrain.press_m_s * passed_s
        early = self._since_s[side] < p.terrain.adapt_early_s
        rate_1_s = p.terrain.adapt_early_1_s if early else p.terrain.adapt_1_s
        rate_1_s *= min(1.0, max(0.0, sole.load) / p.terrain.adapt_load)
        turned = 1.0 - math.exp(-rate_1_s * passed_s)
        # The base is estimated from the loaded feet: only heights of the others can be measured.
        lifted = 1.0 - math.exp(-p.terrain.adapt_height_1_s * (1.0 - share) * passed_s)
        return GroundPlane(
            height_m + lifted * (sole.plane.height_m - height_m),
            told.tilt + turned * (sole.plane.tilt - told.tilt),
        )


def soles_below(
    base_m: Array, robot: WalkingRobot, sensed: RobotState, parameters: WalkParameters
) -> tuple[SoleReading, SoleReading]:
    """
    Compute the poses of both soles, and the loads on them, for a position of the base.

    Parameters
    ----------
    base_m
        Position (3,) of the base in the odom frame.
    robot, sensed
        The robot, and its estimated state.
    parameters : WalkParameters
        Gait parameters, with the maximum tilt of the ground.

    Returns
    -------
    tuple of SoleReading
        Left and right, in the odom frame.

    """
    left, right = (
        _reading(side, base_m, robot, sensed, parameters.terrain.most_tilt_rad)
        for side in (LEFT, RIGHT)
    )
    return left, right


def footing_below(
    start_m: Point,
    robot: WalkingRobot,
    shape: FootShape,
    parameters: WalkParameters,
    sensed: RobotState,
) -> Footing:
    """
    Compute the footholds of both feet for a base above a point of level ground.

    The mean height of the soles is taken as the level of the ground, zero.

    Parameters
    ----------
    start_m
        Point below the base, in the plane of the odom frame.
    robot, shape
        The robot, and the supporting rectangle of its soles.
    parameters : WalkParameters
        Gait parameters, with the maximum tilt of the ground.
    sensed
        Estimated state of the robot.

    Returns
    -------
    Footing
        Footholds of both feet, in the odom frame.

    """
    base_m = np.array([start_m.real, start_m.imag, 0.0])
    soles = soles_below(base_m, robot, sensed, parameters)
    middle_m = sum(sole.plane.height_m for sole in soles) / len(soles)
    return Footing(
        shape,
        [
            Foothold(sole.pose, replace(sole.plane, height_m=sole.plane.height_m - middle_m))
            for sole in soles
        ],
    )


def _reading(
    side: int, base_m: Array, robot: WalkingRobot, sensed: RobotState, most_tilt_rad: float
) -> SoleReading:
    """Compute the pose and the load of one sole."""
    sole = robot.legs[side].sole
    x, y, z = (base_m + sensed.state.position_m(sole)).tolist()
    rotation = sensed.state.rotation(sole)
    plane = GroundPlane(z, tilt_of(rotation, most_tilt_rad))
    pose = PlanarPose(complex(x, y), yaw_of(rotation))
    return SoleReading(pose, plane, sensed.loads[side], sensed.drags[side])
