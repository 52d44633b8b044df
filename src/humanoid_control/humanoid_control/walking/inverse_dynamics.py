# SPDX-License-Identifier: Apache-2.0
"""
Inverse dynamics: the joint torques that realise the planned accelerations.

From the planned accelerations of the centre of mass and of the soles follow those of all joints.
The ground reaction that they require is clamped to what the feet can exert, and the hips hold the
pelvis upright.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.dynamics.body_state import BodyState
from humanoid_control.walking.commands import BodyPoseFollower
from humanoid_control.walking.footing import Footing, GroundReaction, Loads, loads_for
from humanoid_control.walking.gait_context import GaitOutput
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import SIDES, Turning
from humanoid_control.walking.walking_robot import Attitude, Leg, RobotState, WalkingRobot
from humanoid_description.rotations import skew, wrap_angle
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_DAMPING = 0.01
"""Fraction of the leg length: keeps accelerations finite where the leg is stretched."""
_ONE: Array = np.eye(6)


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


@dataclass(frozen=True, eq=False)
class PlannedAcceleration:
    """Planned accelerations, in the axes of the world."""

    com_m_s2: Array
    """(3,) of the centre of mass"""
    turn_rad_s2: Array
    """(3,) angular, of the base"""
    soles: Sequence[Array]
    """(6,) each, left and right: linear, then angular"""
    joints_rad_s2: Array
    """(n,) of the joints that are not in the legs"""


def whole_acceleration(
    state: BodyState, legs: Sequence[LegMap], plan: PlannedAcceleration, limit_rad_s2: float
) -> tuple[Array, Array]:
    """
    Compute the accelerations of root and joints that realise the planned ones.

    The legs follow the soles; the root accelerates so that the centre of mass, including the
    contribution of the legs, gets its planned acceleration.

    Parameters
    ----------
    state
        Measured posture and motion of the robot.
    legs
        Acceleration maps of the legs, left and right.
    plan
        Planned accelerations.
    limit_rad_s2
        Greatest acceleration of a leg joint, to which the results are clamped.

    Returns
    -------
    tuple of Array
        Acceleration of the root (6,), linear in m/s2, then angular in rad/s2, in the axes of the
        world; and accelerations of the joints (n,) in rad/s2.

    """
    base, joints = np.zeros(6), plan.joints_rad_s2.copy()
    base[3:] = plan.turn_rad_s2
    jacobian = state.com_jacobian
    missing = plan.com_m_s2 - state.com_drift_m_s2 - jacobian[:, 3:] @ np.append(base[3:], joints)
    share = np.eye(3)
    without_root = []
    for leg, sole in zip(legs, plan.soles):
        own = jacobian[:, 6 + leg.indices]
        without_root.append(leg.accelerations(sole, base))
        missing -= own @ without_root[-1]
        share -= own @ leg.inverse[:, :3]
    base[:3] = np.linalg.solve(share, missing)
    for leg, alone in zip(legs, without_root):
        followed = alone - leg.inverse[:, :3] @ base[:3]
        joints[leg.indices] = within(followed, limit_rad_s2)
    return base, joints


def within(values: Array, limit: float) -> Array:
    """
    Clip values to plus or minus a limit.

    Parameters
    ----------
    values
        An array of any shape.
    limit
        Greatest magnitude of an element, in the same unit.

    """
    limited: Array = np.minimum(np.maximum(values, -limit), limit)
    return limited


@dataclass(frozen=True, eq=False)
class LegMap:
    """
    Map from the accelerations of sole and base to those of the joints of a leg.

    Accelerations of sole and base are (6,): linear, then angular, in the axes of the world.
    """

    indices: NDArray[np.intp]
    inverse: Array
    """(6, 6)"""
    carry: Array
    """(6, 6) map from the acceleration of the base to that of a sole fixed to it"""
    drift: Array
    """(6,) acceleration bias of the sole: at zero acceleration of base and joints"""

    def accelerations(self, sole: Array, base: Array) -> Array:
        """
        Compute the joint accelerations of the leg for given accelerations of sole and base.

        Parameters
        ----------
        sole, base
            Accelerations (6,): linear in m/s2, then angular in rad/s2, in the axes of the world.

        Returns
        -------
        Array
            Accelerations (6,) of the joints in rad/s2, from the hip down.

        """
        accelerations: Array = self.inverse @ (sole - self.drift - self.carry @ base)
        return accelerations


def leg_maps(legs: Sequence[Leg], state: BodyState) -> list[LegMap]:
    """
    Compute the acceleration maps of legs by damped least squares.

    Parameters
    ----------
    legs
        The legs, in the order of the result.
    state
        Measured posture and motion of the robot.

    Returns
    -------
    list of LegMap
        One for each leg.

    """
    jacobians = np.array([state.jacobian_of(leg.group, leg.sole) for leg in legs])
    turned = jacobians.transpose(0, 2, 1)
    damping = np.array([(_DAMPING * leg.geometry.length_m) ** 2 for leg in legs])
    # Damped least squares (Nakamura and Hanafusa, Inverse kinematic solutions with singularity
    # robustness, ASME Journal of Dynamic Systems 108, 1986).
    squares = turned @ jacobians + damping[:, None, None] * _ONE
    inverses = np.linalg.solve(squares, turned)
    return [_leg_map(leg, state, inverse) for leg, inverse in zip(legs, inverses)]


def _leg_map(leg: Leg, state: BodyState, inverse: Array) -> LegMap:
    """Build the acceleration map of a leg."""
    carry = _ONE.copy()
    carry[:3, 3:] = -skew(state.position_m(leg.sole))
    return LegMap(leg.indices, inverse, carry, state.drift(leg.sole))
