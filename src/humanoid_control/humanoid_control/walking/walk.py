# SPDX-License-Identifier: Apache-2.0
"""A walk: from where the robot stands, tick by tick, to the targets of its joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from humanoid_control.backends import JointTargets
from humanoid_control.dynamics.frames import Frame, Twist
from humanoid_control.dynamics.rotations import about_z, skew
from humanoid_control.walking.attitude import hip_efforts
from humanoid_control.walking.base_estimate import base_on, BaseEstimate, sole_reading
from humanoid_control.walking.com_observer import ComObserver
from humanoid_control.walking.com_reference import ComReference
from humanoid_control.walking.conforming import Conforming
from humanoid_control.walking.feed_forward import ground_efforts
from humanoid_control.walking.foot_shape import FootShape
from humanoid_control.walking.footing import Foothold, Footing, loads_for
from humanoid_control.walking.gait import Gait, GaitOutput
from humanoid_control.walking.gear import GaitInput, Gear, SoleReading
from humanoid_control.walking.ground_reaction import GroundReaction
from humanoid_control.walking.home_posture import HomePosture
from humanoid_control.walking.leg_map import leg_maps
from humanoid_control.walking.leg_reach import reachable_height_m
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import Motion, Pendulum
from humanoid_control.walking.planar import Point
from humanoid_control.walking.planned_acceleration import (
    PlannedAcceleration,
    whole_acceleration,
    within,
)
from humanoid_control.walking.senses import Sensed
from humanoid_control.walking.sides import SIDES
from humanoid_control.walking.terrain import GroundLevel
from humanoid_control.walking.turning import Turning
from humanoid_control.walking.walking_robot import WalkingRobot
from humanoid_control.walking.whole_body import BaseMotion, JointMotion, WholeBody
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Walk:
    """A walk that has begun: the estimate of the robot, the gait and the references."""

    def __init__(
        self,
        robot: WalkingRobot,
        shape: FootShape,
        home: HomePosture,
        parameters: WalkParameters,
        sensed: Sensed,
        start_m: Point,
    ) -> None:
        """Begin with both feet on the ground where they are, the base above a point."""
        self._robot = robot
        self._parameters = parameters
        self._pendulum = Pendulum(home.com_height_m)
        self._footing = _footing_below(start_m, robot, shape, parameters, sensed)
        self.gait = Gait(Gear(parameters, self._pendulum, self._footing))
        self._observer = ComObserver(self._pendulum, parameters.observer_rate_1_s)
        self._reference = ComReference(
            self._pendulum, parameters.reference_leak_1_s, parameters.reference_distance_m
        )
        self._whole_body = WholeBody(robot, home, parameters)
        self._conforming = Conforming(parameters)
        self._level = GroundLevel(parameters.level_rate_1_s, parameters.level_leak_1_s, 0.0)
        self._shares = (0.5, 0.5)
        self._zmp_m = self._footing.rest_point
        self._last_s = sensed.time_s
        self.sensed = sensed
        self.base = base_on(self._footing, self._shares, robot, sensed.state)
        self.com = self.base.com_motion(sensed.state)
        self.output: GaitOutput | None = None

    @property
    def dcm_m(self) -> Point:
        """Return the divergent component of motion, as estimated."""
        return self._pendulum.dcm(self.com)

    @property
    def footing(self) -> Footing:
        """Return where the feet stand."""
        return self._footing

    def update(self, sensed: Sensed) -> JointTargets:
        """Return what the joints are to do next."""
        passed_s = sensed.time_s - self._last_s
        self._last_s, self.sensed = sensed.time_s, sensed
        self._estimate(passed_s)
        soles = self._soles()
        output = self.output = self.gait.update(
            GaitInput(passed_s, self.dcm_m, self._zmp_m, soles)
        )
        self._zmp_m = output.zmp_m
        wanted = self._reference.update(self.com, output.zmp_m, passed_s)
        self._give_way(soles, output, passed_s)
        joints = self._whole_body.motion(
            self._within_reach(self._wanted_base(wanted, output.turning), output.sides),
            self._measured_base(),
            self._footing,
            output.swing,
        )
        limit = self._parameters.velocity_limit_rad_s
        velocities = within(joints.velocities_rad_s, limit)
        return JointTargets(joints.positions_rad, velocities, self._efforts(output, joints))

    def lie(self, sensed: Sensed) -> None:
        """Note that the robot does not walk now: it is where it was last, turned as it is."""
        self._last_s, self.sensed = sensed.time_s, sensed
        self.base = BaseEstimate(self.base.position_m, np.zeros(3))

    def _estimate(self, passed_s: float) -> None:
        """Find base and centre of mass from the feet that carried weight until now."""
        state = self.sensed.state
        self.base = base_on(self._footing, self._shares, self._robot, state)
        measured = self.base.com_motion(state)
        self.com = self._observer.update(measured, self._zmp_m, passed_s)

    def _soles(self) -> tuple[SoleReading, SoleReading]:
        """Return where the soles are measured."""
        left, right = (
            sole_reading(
                self._robot.legs[side].sole,
                self.base.position_m,
                self.sensed.state,
                self.sensed.loads[side],
                self._parameters.most_tilt_rad,
            )
            for side in SIDES
        )
        return left, right

    def _give_way(
        self, soles: tuple[SoleReading, SoleReading], output: GaitOutput, passed_s: float
    ) -> None:
        """Adapt to the ground under the feet."""
        in_air = output.swing.side if output.swing else None
        shares = loads_for(self._footing, output.sides, output.zmp_m).shares
        self._conforming.update(self._footing, soles, shares, in_air, passed_s)
        com_m = float(self.base.position_m[2] + self.sensed.state.com_m[2])
        self._level.update(
            self._footing.height_m(shares),
            com_m - self._pendulum.height_m,
            passed_s,
        )

    @property
    def _base_above_ground_m(self) -> Array:
        """Return where the base is (3,), above the level of the ground."""
        above_m: Array = self.base.position_m - (0.0, 0.0, self._level.height_m)
        return above_m

    def _measured_base(self) -> BaseMotion:
        """Return the base as estimated."""
        state = self.sensed.state
        return BaseMotion(
            Frame(self.base.position_m, state.base_rotation),
            Twist(self.base.velocity_m_s, state.base_angular_velocity_rad_s),
        )

    def _wanted_base(self, com: Motion, turning: Turning) -> BaseMotion:
        """Return the base that is upright, faces a heading and has the centre of mass right."""
        state, point, speed = self.sensed.state, self.com.position_m, com.velocity_m_s
        rotation = about_z(turning.heading_rad)
        upright = rotation @ state.base_rotation.T
        from_base = np.array([point.real, point.imag, 0.0]) - self.base.position_m
        from_base[2] = state.com_m[2]
        to_com = upright @ from_base
        shifting = upright @ (
            state.com_velocity_m_s - skew(state.base_angular_velocity_rad_s) @ state.com_m
        )
        goal = np.array(
            [
                com.position_m.real,
                com.position_m.imag,
                self._pendulum.height_m + self._level.height_m,
            ]
        )
        turn = np.array([0.0, 0.0, turning.rate_rad_s])
        velocity = np.array([speed.real, speed.imag, 0.0]) - shifting - skew(turn) @ to_com
        return BaseMotion(Frame(goal - to_com, rotation), Twist(velocity, turn))

    def _within_reach(self, base: BaseMotion, sides: Sequence[int]) -> BaseMotion:
        """Return the base so low that the legs on the ground need not be stretched."""
        legs = [self._robot.legs[side].geometry for side in sides]
        soles = [self._footing[side].sole_m for side in sides]
        x, y, _ = base.frame.position_m.tolist()
        height_m = reachable_height_m(base.frame, legs, soles, self._parameters.leg_reach)
        return BaseMotion(Frame(np.array([x, y, height_m]), base.frame.rotation), base.twist)

    def _efforts(self, output: GaitOutput, motion: JointMotion) -> Array:
        """Return the efforts (n,) that move the robot as planned and keep it upright."""
        state, p = self.sensed.state, self._parameters
        maps = leg_maps(self._robot.legs, state)
        base, joints = whole_acceleration(
            state, maps, self._planned(output, motion), p.acceleration_limit_rad_s2
        )
        wrench, efforts = state.required(base, joints)
        reaction = GroundReaction.of(wrench, self._base_above_ground_m).within(
            self._footing.polygon(output.sides), p.ground_turn_nm
        )
        loads = loads_for(self._footing, output.sides, reaction.point_m)
        self._shares = loads.shares
        efforts -= ground_efforts(self._robot, state, self._base_above_ground_m, loads, reaction)
        upright = hip_efforts(p, self.sensed.attitude, output.turning)
        for side in SIDES:
            efforts[self._robot.legs[side].indices[:3]] += loads.shares[side] * upright
        return efforts

    def _planned(self, output: GaitOutput, motion: JointMotion) -> PlannedAcceleration:
        """Return what is planned: a pendulum, upright, over feet that stand or swing."""
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


def _footing_below(
    start_m: Point,
    robot: WalkingRobot,
    shape: FootShape,
    parameters: WalkParameters,
    sensed: Sensed,
) -> Footing:
    """Return the feet where they are while the base is above a point."""
    base, steepest = np.array([start_m.real, start_m.imag, 0.0]), parameters.most_tilt_rad
    left, right = (sole_reading(leg.sole, base, sensed.state, 0.5, steepest) for leg in robot.legs)
    middle_m = (left.facet.height_m + right.facet.height_m) / 2
    return Footing(
        shape,
        [
            Foothold(sole.pose, replace(sole.facet, height_m=sole.facet.height_m - middle_m))
            for sole in (left, right)
        ],
    )
