# SPDX-License-Identifier: Apache-2.0
"""Control loop of a walk, from the estimated state to joint targets, and its status."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_control.backends import JointTargets
from humanoid_control.walking.commands import (
    BodyPose,
    BodyPoseFollower,
    STANDING,
    UPRIGHT,
    VelocityCommand,
)
from humanoid_control.walking.footing import Footing, loads_for, SoleReading
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gait import Gait, STAND
from humanoid_control.walking.gait_context import GaitContext, GaitInput, GaitOutput
from humanoid_control.walking.inverse_dynamics import InverseDynamics, PlannedAcceleration, within
from humanoid_control.walking.obstacle_guard import NOTHING, Touch
from humanoid_control.walking.odometry import (
    base_on,
    BaseEstimate,
    BaseMotion,
    carrying,
    Odometry,
)
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import (
    ComObserver,
    ComReference,
    GRAVITY_M_S2,
    Motion,
    Pendulum,
)
from humanoid_control.walking.planar import PlanarPose, Point, SIDES
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.terrain import (
    FootholdAdaptation,
    footing_below,
    GroundLevel,
    LevelFloor,
    soles_below,
)
from humanoid_control.walking.touch import ForceObserver, TouchObserver
from humanoid_control.walking.walking_robot import HomePosture, RobotState, WalkingRobot
from humanoid_control.walking.whole_body import base_below, JointMotion, WholeBody, within_reach
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Walk:
    """
    Walk in progress: the estimates of the robot, the gait and the references.

    It starts with both feet on the ground, wherever they are.

    Parameters
    ----------
    robot, shape, home
        The robot, the supporting rectangle of its soles, and its standing posture.
    parameters : WalkParameters
        Gait parameters.
    sensed
        Estimated state of the robot at the start.
    start_m
        Point of the ground below the base at the start, in the odom frame.

    Attributes
    ----------
    base
        Estimated position and velocity of the base, in the odom frame.
    com
        Estimated horizontal motion of the centre of mass, in the odom frame.
    output
        Output of the gait in this control period; None before the first `update`.

    Raises
    ------
    DynamicsError
        The robot lacks a joint of the hips or shoulders.

    """

    def __init__(
        self,
        robot: WalkingRobot,
        shape: FootShape,
        home: HomePosture,
        parameters: WalkParameters,
        sensed: RobotState,
        start_m: Point,
    ) -> None:
        self._robot = robot
        self._soles = tuple(leg.sole for leg in robot.legs)
        self._parameters = parameters
        self._pendulum = Pendulum(home.com_height_m)
        self._footing = footing_below(start_m, robot, shape, parameters, sensed)
        self.gait = Gait(GaitContext(parameters, self._pendulum, self._footing))
        self._observer = ComObserver(self._pendulum, parameters.balance.observer_rate_1_s)
        self._reference = ComReference(
            self._pendulum,
            parameters.balance.reference_leak_1_s,
            parameters.balance.reference_distance_m,
        )
        self._whole_body = WholeBody(robot, home, parameters)
        self._dynamics = InverseDynamics(robot, parameters, self._footing)
        self._adaptation = FootholdAdaptation(parameters)
        self._level = GroundLevel(
            parameters.terrain.level_rate_1_s,
            parameters.terrain.level_leak_1_s,
            parameters.terrain.level_distance_m,
        )
        self._floor = LevelFloor(parameters.terrain.level_tolerance_m)
        self._force = ForceObserver(robot.body.mass_kg, parameters.obstacles.force_rate_1_s)
        self._touch = TouchObserver(robot, parameters)
        self.body = BodyPoseFollower(parameters.body_pose)
        """Body pose, which follows the commanded one at limited rates."""
        self._shares = (0.5, 0.5)
        self._zmp_m = self._footing.rest_point
        self._error_m = 0j
        self._last_s = sensed.time_s
        self.sensed = sensed
        self.base = base_on(self._footing, self._shares, self._soles, sensed.state)
        self.com = self.base.com_motion(sensed.state)
        self.output: GaitOutput | None = None

    @property
    def dcm_m(self) -> Point:
        """Return the estimated divergent component of motion."""
        return self._pendulum.dcm(self.com)

    @property
    def footing(self) -> Footing:
        """Return the footholds of the feet."""
        return self._footing

    @property
    def height_m(self) -> float:
        """Return the height of the base above the floor on which the walk started."""
        return float(self.base.position_m[2]) + self._floor.rise_m(self._shares)

    def update(
        self, sensed: RobotState, velocity: VelocityCommand, pose: BodyPose
    ) -> JointTargets:
        """
        Compute the joint targets of the next control period.

        A robot that is bent straightens up before its first step.

        Parameters
        ----------
        sensed
            Estimated state of the robot.
        velocity
            Commanded velocity in the axes of the robot; the gait clamps it to its limits.
        pose
            Body pose to hold while standing, within the limits of the robot.

        Returns
        -------
        JointTargets
            Targets of the n joints that walking uses, with feed-forward torques.

        """
        passed_s = sensed.time_s - self._last_s
        self._last_s, self.sensed = sensed.time_s, sensed
        self._estimate(passed_s)
        self._hold_body(velocity, pose, passed_s)
        soles = soles_below(self.base.position_m, self._robot, sensed, self._parameters)
        output = self.output = self.gait.update(
            GaitInput(
                passed_s,
                self.dcm_m,
                self._zmp_m,
                soles,
                velocity if self.body.is_upright else STANDING,
                self._error_m,
                self._force.force_n,
                self._felt(),
            )
        )
        self._zmp_m = output.zmp_m
        self._error_m = self.dcm_m - output.reference.dcm_m
        wanted = self._reference.update(self.com, output.zmp_m, passed_s)
        self._give_way(soles, output, passed_s)
        joints = self._whole_body.motion(
            self._wanted_base(wanted, output),
            self.base.motion(sensed.state),
            self._footing,
            output.swing,
        )
        plan = self._planned(output, joints)
        torques = self._dynamics.torques(
            sensed, self._base_above_ground_m, output, plan, self.body
        )
        self._shares = torques.shares
        velocities = within(joints.velocities_rad_s, self._parameters.joints.velocity_limit_rad_s)
        return JointTargets(joints.positions_rad, velocities, torques.efforts_nm)

    def lie(self, sensed: RobotState) -> None:
        """
        Update the base estimate of a robot that is down.

        It keeps its position in the plane, with the measured orientation and its lowest link on
        the ground.

        Parameters
        ----------
        sensed
            Estimated state of the robot.

        """
        self._last_s, self.sensed = sensed.time_s, sensed
        state = sensed.state
        lowest_m = min(float(state.position_m(link)[2]) for link in self._robot.body.links)
        position = self.base.position_m.copy()
        position[2] = self._footing.height_m(self._shares) - lowest_m
        self.base = BaseEstimate(position, np.zeros(3))

    def _hold_body(self, velocity: VelocityCommand, pose: BodyPose, passed_s: float) -> None:
        """Move the body towards the commanded pose, or upright if the robot is to step."""
        stands = self.gait.phase == STAND and velocity.is_zero
        self.body.update(pose if stands else UPRIGHT, passed_s)

    def _estimate(self, passed_s: float) -> None:
        """Estimate the base, the centre of mass and the external force."""
        state = self.sensed.state
        shares = carrying(self._shares, self.sensed.loads)
        self.base = base_on(self._footing, shares, self._soles, state)
        measured = self.base.com_motion(state)
        self.com = self._observer.update(measured, self._zmp_m, passed_s)
        swing = self.output.swing if self.output else None
        # A force on the swing foot is not one of the ground.
        drag = sum(
            drag
            for side, drag in enumerate(self.sensed.drags)
            if swing is None or side != swing.side
        )
        weight_n = self._robot.body.mass_kg * GRAVITY_M_S2
        self._force.update(measured.velocity_m_s, weight_n * drag, passed_s)

    def _felt(self) -> Touch:
        """Estimate the contacts of the limbs; none while the robot stands."""
        if self.gait.phase == STAND:
            self._touch.rest(self.sensed)
            return NOTHING
        return self._touch.update(self.sensed)

    def _give_way(
        self, soles: tuple[SoleReading, SoleReading], output: GaitOutput, passed_s: float
    ) -> None:
        """Adapt the footholds and the ground level to the ground below the feet."""
        in_air = output.swing.side if output.swing else None
        shares = loads_for(self._footing, output.sides, output.zmp_m).shares
        self._adaptation.update(self._footing, soles, shares, in_air, passed_s)
        self._floor.update([self._footing[side].plane.height_m for side in SIDES], in_air)
        com_m = float(self.base.position_m[2] + self.sensed.state.com_m[2])
        self._level.update(
            self._footing.height_m(shares),
            com_m - self._pendulum.height_m - self.body.pose.height_m,
            passed_s,
        )

    @property
    def _base_above_ground_m(self) -> Array:
        """Return the position (3,) of the base, with z above the ground level."""
        above_m: Array = self.base.position_m - (0.0, 0.0, self._level.height_m)
        return above_m

    def _wanted_base(self, com: Motion, output: GaitOutput) -> BaseMotion:
        """Compute the motion of the base that gives the centre of mass its reference motion."""
        body = self.body
        height_m = self._pendulum.height_m + self._level.height_m + body.pose.height_m
        base = base_below(
            com,
            height_m,
            output.turning,
            self.com,
            self.base,
            self.sensed.state,
            body.pose.pitch_rad,
            body.pitch_rate_rad_s,
        )
        reach = self._parameters.posture.leg_reach
        return within_reach(base, self._robot, self._footing, output.sides, reach)

    def _planned(self, output: GaitOutput, motion: JointMotion) -> PlannedAcceleration:
        """Compute the planned accelerations: pendulum, upright base, stance and swing feet."""
        along = self._pendulum.acceleration_m_s2(self.com.position_m, output.zmp_m)
        soles = [np.zeros(6), np.zeros(6)]
        if output.swing:
            soles[output.swing.side] = output.swing.sole.acceleration
        return PlannedAcceleration(
            np.array([along.real, along.imag, 0.0]),
            np.zeros(3),
            soles,
            motion.accelerations_rad_s2,
        )


@dataclass(frozen=True, eq=False)
class WalkStatus:
    """Status of the walk at a time; points are in the ground plane of the odom frame."""

    phase: str
    """'stand', 'walk', 'stop', 'fallen' or 'stand_up'."""
    support: tuple[int, ...]
    """Sides of the feet that carry the robot: 0 left, 1 right; empty while it is down."""
    feet: tuple[PlanarPose, PlanarPose]
    """Present or last footholds, left and right."""
    footsteps: Sequence[Footstep]
    """Planned landings, the next one first."""
    odometry: Odometry
    dcm_m: Point
    dcm_reference_m: Point
    zmp_m: Point
    """Commanded zero-moment point."""
    zmp_reference_m: Point
