# SPDX-License-Identifier: Apache-2.0
"""Inverse dynamics: the joint torques that realise the planned accelerations."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.walking.attitude import hip_efforts
from humanoid_control.walking.body_pose import BodyPoseFollower
from humanoid_control.walking.feed_forward import ground_efforts
from humanoid_control.walking.footing import Footing, loads_for
from humanoid_control.walking.gait import GaitOutput
from humanoid_control.walking.ground_reaction import GroundReaction
from humanoid_control.walking.leg_map import leg_maps
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planned_acceleration import (
    PlannedAcceleration,
    whole_acceleration,
)
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.state_estimator import RobotState
from humanoid_control.walking.walking_robot import WalkingRobot
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class JointTorques:
    """Joint torques, and the load distribution over the feet that results."""

    efforts_nm: Array
    """(n,)"""
    shares: tuple[float, float]


@dataclass(frozen=True, eq=False)
class InverseDynamics:
    """Inverse dynamics of a robot that stands on one or both feet."""

    robot: WalkingRobot
    parameters: WalkParameters
    footing: Footing

    def torques(
        self,
        sensed: RobotState,
        base_m: Array,
        output: GaitOutput,
        plan: PlannedAcceleration,
        body: BodyPoseFollower,
    ) -> JointTorques:
        """
        Compute the joint torques that realise the planned accelerations and hold the pelvis.

        The required ground reaction is clamped to what the feet can exert: a centre of pressure
        within the support polygon, and a bounded torque about the vertical.

        Parameters
        ----------
        sensed
            Estimated state of the robot.
        base_m
            Position (3,) of the base: x and y in the odom frame, z above the level of the ground.
        output
            Output of the gait: the feet that carry the robot, and the heading of the pelvis.
        plan
            Planned accelerations, in the axes of the odom frame.
        body
            Target pitch of the pelvis, and its rate.

        Returns
        -------
        JointTorques
            The feed-forward torques (n,) in N m, and the load distribution over the feet.

        """
        p, state = self.parameters, sensed.state
        maps = leg_maps(self.robot.legs, state)
        base, joints = whole_acceleration(state, maps, plan, p.joints.acceleration_limit_rad_s2)
        wrench, efforts = state.required(base, joints)
        reaction = GroundReaction.of(wrench, base_m).within(
            self.footing.polygon(output.sides), p.balance.ground_turn_nm
        )
        loads = loads_for(self.footing, output.sides, reaction.point_m)
        efforts -= ground_efforts(self.robot, state, base_m, loads, reaction)
        upright = hip_efforts(
            p, sensed.attitude, output.turning, body.pose.pitch_rad, body.pitch_rate_rad_s
        )
        for side in SIDES:
            efforts[self.robot.legs[side].indices[:3]] += loads.shares[side] * upright
        return JointTorques(efforts, loads.shares)
