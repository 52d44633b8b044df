# SPDX-License-Identifier: Apache-2.0
"""What walking needs to know of a robot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from humanoid_control.dynamics import BodyModel, JointGroup
from humanoid_control.dynamics.leg_geometry import LegGeometry
from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.sides import LEFT, NAMES, RIGHT
from humanoid_description.drives import Drive
from humanoid_description.kinematics import chain, pose_along
from humanoid_description.robot import Robot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Leg:
    """A leg: its joints among all, and its inverse kinematics."""

    group: JointGroup
    geometry: LegGeometry

    @classmethod
    def of(cls, robot: Robot, body: BodyModel, side: int) -> Leg:
        """Return the leg of a side."""
        geometry = LegGeometry.of(robot, NAMES[side])
        return cls(body.group(geometry.joints), geometry)

    @property
    def sole(self) -> str:
        """Return the link under its foot."""
        return self.geometry.sole

    @property
    def indices(self) -> NDArray[np.intp]:
        """Return the places (6,) of its joints among all, from the hip down."""
        return self.group.indices


@dataclass(frozen=True, eq=False)
class WalkingRobot:
    """A robot with two legs, as arrays in the order of its joints."""

    body: BodyModel
    prefix: str
    legs: tuple[Leg, Leg]
    imu_in_base: Array
    """(3, 3)"""

    @classmethod
    def of(cls, robot: Robot, drives: Mapping[str, Drive], joints: Sequence[str]) -> WalkingRobot:
        """
        Return what walking needs of a robot.

        :param joints: all driven joints, in the order of observations and targets
        :raises WalkingError: if a joint has no drive
        :raises DynamicsError: if the robot lacks a leg, or has legs of another build
        """
        undriven = [name for name in joints if name not in drives]
        if undriven:
            raise WalkingError(
                f'There is no drive for {", ".join(undriven)}: config/joints.yaml lacks it.'
            )
        body = BodyModel.of(robot, joints, [drives[joint].armature_kgm2 for joint in joints])
        legs = (Leg.of(robot, body, LEFT), Leg.of(robot, body, RIGHT))
        imu = pose_along(chain(robot, robot.prefix + 'imu_link'), {})
        return cls(body, robot.prefix, legs, imu[:3, :3])

    def index(self, joint: str) -> int:
        """Return the place of a joint, named without the prefix, among all."""
        return self.body.index(self.prefix + joint)
