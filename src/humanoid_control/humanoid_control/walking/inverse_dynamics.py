# SPDX-License-Identifier: Apache-2.0
"""
Inverse dynamics: the joint torques that realise the planned accelerations.

The ground reaction that they require is clamped to what the feet can exert, and the hips hold the
pelvis upright.
"""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.walking.body_pose import BodyPoseFollower
from humanoid_control.walking.footing import Footing, Loads, loads_for
from humanoid_control.walking.gait_context import GaitOutput
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import limited, Point, Turning
from humanoid_control.walking.planned_acceleration import (
    leg_maps,
    PlannedAcceleration,
    whole_acceleration,
)
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.state_estimator import Attitude, RobotState
from humanoid_control.walking.support_polygon import SupportPolygon
from humanoid_control.walking.walking_robot import WalkingRobot
from humanoid_description.rotations import wrap_angle
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


def ground_efforts(
    robot: WalkingRobot, state: BodyState, base_m: Array, loads: Loads, reaction: GroundReaction
) -> Array:
    """
    Map the ground reaction to joint torques with the transposed Jacobians of the feet.

    Parameters
    ----------
    robot, state
        The robot and its measured state.
    base_m
        Origin of base_link (3,): x and y in the odom frame, z above the ground.
    loads
        Load distribution, and the centre of pressure under each foot in the odom frame.
    reaction
        Total force of the ground, and its torque about the vertical.

    Returns
    -------
    Array
        Torques (n,) in N m that the ground exerts on the joints. Subtract them from those of
        inverse dynamics to get what the actuators have to exert.

    """
    efforts: Array = np.zeros(len(robot.body.joints))
    turn = np.array([0.0, 0.0, reaction.turn_nm])
    for side in SIDES:
        share, point = loads.shares[side], loads.points_m[side]
        if share > 0.0:
            place = np.array([point.real, point.imag, 0.0]) - base_m
            sole = robot.legs[side].sole
            efforts += share * state.efforts_of_force_nm(sole, place, reaction.force_n, turn)
    return efforts


def hip_efforts(
    parameters: WalkParameters,
    attitude: Attitude,
    turning: Turning,
    pitch_rad: float = 0.0,
    pitch_rate_rad_s: float = 0.0,
) -> Array:
    """
    Compute the hip torques that hold the pelvis upright and on its heading.

    A PD law on the attitude for a leg that carries the whole weight: scale the torques by the
    share of the load on each leg.

    Parameters
    ----------
    parameters : WalkParameters
        Stiffness and damping of the attitude, and the fraction of both that acts on the heading.
    attitude
        Measured attitude of base_link in the odom frame, and rates in its own axes.
    turning
        Wanted heading of the pelvis in the odom frame, and its rate.
    pitch_rad, pitch_rate_rad_s
        Wanted pitch of the pelvis, positive when it is bent forward, and its rate.

    Returns
    -------
    Array
        Torques (3,) of hip yaw, roll and pitch in N m.

    """
    stiffness, damping = (
        parameters.balance.attitude_stiffness_nm_rad,
        parameters.balance.attitude_damping_nms_rad,
    )
    roll, pitch, yaw = attitude.rates_rad_s
    off_course_rad = wrap_angle(attitude.yaw_rad - turning.heading_rad)
    return np.array(
        [
            parameters.balance.heading_share
            * (stiffness * off_course_rad + damping * (yaw - turning.rate_rad_s)),
            stiffness * attitude.roll_rad + damping * roll,
            stiffness * (attitude.pitch_rad - pitch_rad) + damping * (pitch - pitch_rate_rad_s),
        ]
    )
