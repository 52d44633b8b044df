# SPDX-License-Identifier: Apache-2.0
"""
Adaptation to the ground: footholds that follow the measured soles, and the ground level.

The ground is not seen: the feet measure its height and its tilt.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
import math

from humanoid_control.walking.footing import Foothold, Footing, SoleReading
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import (
    GroundPlane,
    LEFT,
    limited,
    other,
    PlanarPose,
    Point,
    RIGHT,
    SIDES,
    tilt_of,
)
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.walking_robot import RobotState, WalkingRobot
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


@dataclass
class GroundLevel:
    """
    Low-pass filter of the ground level below the pendulum.

    It follows the height of the feet, weighted by their load, and leaks to the level that the
    measured centre of mass implies, so that a landing that is too high or too low causes no jolt.
    It stays near the feet, so that a robot that sinks does not drag it down.
    """

    rate_1_s: float
    leak_1_s: float
    most_distance_m: float
    height_m: float = 0.0

    def update(self, feet_m: float, below_com_m: float, passed_s: float) -> None:
        """
        Low-pass filter the height of the ground below the pendulum.

        Parameters
        ----------
        feet_m
            Mean height of the feet, weighted by their load.
        below_com_m
            Ground level at which the measured centre of mass would be at its planned height.
        passed_s
            Time since the last control period.

        """
        to_feet = 1.0 - math.exp(-self.rate_1_s * passed_s)
        to_com = 1.0 - math.exp(-self.leak_1_s * passed_s)
        before_m = self.height_m
        height_m = before_m + to_feet * (feet_m - before_m) + to_com * (below_com_m - before_m)
        away_m = limited(height_m - feet_m, -self.most_distance_m, self.most_distance_m)
        self.height_m = feet_m + away_m


class LevelFloor:
    """
    Height correction that treats successive footholds of about the same height as a level floor.

    Leg odometry has a small error at each foothold, and an IMU with a pitch bias makes the robot
    seem to climb as long as it walks forward: without this correction, the height of the floor
    drifts by centimetres in a home. A foot that stands higher or lower than its previous
    foothold, by more than a tolerance, is on a step or on a slope. Left and right are not
    compared: with a roll bias of the IMU, one of them always seems higher.

    Parameters
    ----------
    tolerance_m
        Greatest apparent difference in height between successive footholds on the same floor.

    """

    def __init__(self, tolerance_m: float) -> None:
        self._tolerance_m = tolerance_m
        self._before_m, self._rise_m = [0.0, 0.0], [0.0, 0.0]
        self._support: int | None = None

    def update(self, heights_m: Sequence[float], in_air: int | None) -> None:
        """
        Estimate the drift of the height from a foot that has just taken the weight.

        Parameters
        ----------
        heights_m
            Heights of both feet by odometry, left and right.
        in_air
            Side of the swing foot; the other one carries. None if both feet are on the ground.

        """
        if in_air is None or self._support == other(in_air):
            return
        side = self._support = other(in_air)
        step_m = heights_m[side] - self._before_m[side]
        if abs(step_m) <= self._tolerance_m:
            self._rise_m[side] -= step_m
        self._before_m[side] = heights_m[side]

    def rise_m(self, shares: Sequence[float]) -> float:
        """
        Compute the correction that cancels the drift of the height.

        Parameters
        ----------
        shares
            Load distribution, left and right; the sum is 1.

        Returns
        -------
        float
            Correction in m, to be added to a height by odometry.

        """
        return sum(share * rise_m for share, rise_m in zip(shares, self._rise_m))
