# SPDX-License-Identifier: Apache-2.0
"""A step: the weight shifts to one foot, and the other one swings to its landing."""

from __future__ import annotations

from humanoid_control.walking.footing import Foothold, SoleReading
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gait_context import GaitContext, GaitInput
from humanoid_control.walking.obstacle_guard import LegInAir
from humanoid_control.walking.pendulum import BalanceReference, DcmPlan
from humanoid_control.walking.planar import (
    GroundPlane,
    other,
    PlanarPose,
    Point,
    SIDES,
    smooth_turn,
    Turning,
)
from humanoid_control.walking.step_adjustment import Residual, StepAdjuster
from humanoid_control.walking.swing_foot import StepClock, Swing, SwingTrajectory
from humanoid_control.walking.touchdown import Touchdown

_INSTANT_S = 1e-4
"""Until the foot has landed, the plan is evaluated no later than this before the step ends."""


class CurrentStep:
    """
    The step in progress, with a clock that may run faster to catch the robot.

    Parameters
    ----------
    context
        Context shared by the phases of the gait.
    support
        Side of the foot that carries the robot; the other one swings.
    shift_s
        Duration of double support, in which the weight shifts to the support foot.
    zmp
        Zero-moment point in use at the start (m), in the odom frame.

    Attributes
    ----------
    side
        Side of the swing foot.
    error_m
        Distance of the divergent component of motion from its reference.

    """

    def __init__(self, context: GaitContext, support: int, shift_s: float, zmp: Point) -> None:
        self._context = context
        self.support = support
        self.side = other(support)
        self._clock = StepClock(context.parameters, shift_s)
        self.error_m = 0.0
        self._lifted_from = context.footing[self.side]
        self._lift_off = self._lifted_from.pose
        self._trajectory = SwingTrajectory(context.parameters, self._lift_off, context.slope)
        self._touchdown = Touchdown(context.parameters.swing)
        self._landing = LandingPlan(context, support, shift_s, zmp)

    @property
    def duration_s(self) -> float:
        """Return the actual duration, with the weight shift counted at its regular duration."""
        return self._clock.duration_s

    @property
    def sides(self) -> tuple[int, ...]:
        """Return the sides of the feet that carry the robot."""
        return SIDES if self._clock.in_air_s < 0.0 else (self.support,)

    @property
    def footsteps(self) -> list[Footstep]:
        """Return the planned footsteps, this one first."""
        return self._landing.footsteps

    def advance(self, now: GaitInput) -> bool:
        """
        Advance the step by one control period, and detect the touchdown of the swing foot.

        During a gap in control the swing foot received no targets. It must not rush to catch up:
        the step waits for it. The foot stays where it touches the ground, early or late, until
        the step ends. A contact that is lost was not the ground: it gave way, or the foot only
        grazed it, and the swing resumes.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.

        Returns
        -------
        bool
            Whether the foot can take the weight, or its landing is overdue.

        """
        sole, clock, touchdown = now.soles[self.side], self._clock, self._touchdown
        clock.advance(now.passed_s, waits=not touchdown.has_touched)
        swings = clock.swing_phase > 0.0 and not touchdown.has_touched
        if swings and now.passed_s > clock.passed_s:
            self._trajectory.restart(sole.pose)
        if touchdown.update(sole, clock, now.passed_s):
            if touchdown.has_touched:
                self._stay(sole)
            else:
                self._swing_on(sole)
        return touchdown.may_bear(sole, clock)

    def _stay(self, sole: SoleReading) -> None:
        """Make a foothold of where the foot has touched the ground."""
        plane = GroundPlane(sole.plane.height_m, self._trajectory.tilt)
        self._context.footing.put(self.side, Foothold(sole.pose, plane))

    def _swing_on(self, sole: SoleReading) -> None:
        """Resume the swing from where the foot has lost its contact."""
        self._context.footing.put(self.side, self._lifted_from)
        self._trajectory.restart(sole.pose)
        if self._clock.arrival_s < self._context.parameters.swing.least_s:
            self._landing.move(sole.pose)

    def replan(self, now: GaitInput) -> None:
        """
        Replan the landing for a velocity that has changed abruptly.

        Once the foot has touched the ground, or shortly before its landing, nothing changes.

        Parameters
        ----------
        now
            As for `Phase.replan`.

        """
        clock = self._clock
        if self._touchdown.has_touched or clock.elapsed_s > clock.adjustable_until_s:
            return
        blockage = self._context.guard.blockage
        if blockage and blockage.leg is not None:
            # The foot is not where it was planned to be.
            self._trajectory.restart(now.soles[self.side].pose)
        self._landing.restart(self._trajectory.in_time(self._landing.next_pose(), clock))

    def leg_in_air(self, now: GaitInput) -> LegInAir | None:
        """
        Get the swing leg, if only an obstacle can push it now.

        Parameters
        ----------
        now
            As for `Phase.leg_in_air`.

        Returns
        -------
        LegInAir or None
            None outside the swing and at its start, and once the foot bears load or has touched.

        """
        p, sole = self._context.parameters, now.soles[self.side]
        swings = (
            p.obstacles.leg_touch_from_phase < self._clock.swing_phase < 1.0
            and not self._touchdown.has_touched
        )
        if not swings or sole.load > p.swing.touch_load:
            return None
        return LegInAir(self.side, now.touch.legs_nm[self.side], sole.pose.position_m)

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of DCM and ZMP, and adjust the landing to the error of the DCM.

        Parameters
        ----------
        now
            As for `Phase.reference`, which also describes the result.

        """
        clock, landing = self._clock, self._landing
        landing.heed_stop()
        time_s = min(clock.elapsed_s, clock.end_s - _INSTANT_S)
        if clock.elapsed_s < clock.adjustable_until_s:
            landing.adjust(now.dcm_m, self.sides, time_s, clock)
        reference = landing.at(time_s)
        self.error_m = abs(now.dcm_m - reference.dcm_m)
        return reference

    @property
    def turning(self) -> Turning:
        """Return the mean heading of the feet, interpolated from lift-off to landing."""
        support = self._context.footing.pose(self.support)
        before, after = support.halfway(self._lift_off), support.halfway(self._landing.pose)
        clock = self._clock
        turning = smooth_turn(before.yaw_rad, after.yaw_rad, clock.elapsed_s, clock.end_s)
        return Turning(turning.heading_rad, turning.rate_rad_s * clock.rate)

    def swing(self) -> Swing | None:
        """Compute the swing foot target, or None without one; call it once per control period."""
        if self._clock.in_air_s <= 0.0 or self._touchdown.has_touched:
            return None
        sole = self._trajectory.advance(
            self._clock,
            self._landing.pose,
            self._context.footing[self.side].plane,
            self._rise_m,
            self._context.slope,
        )
        return Swing(self.side, sole)

    @property
    def _rise_m(self) -> float:
        """Return the expected height of the ground at the landing above that at the lift-off."""
        footing, slope = self._context.footing, self._context.slope
        way_m = self._landing.pose.position_m - footing.pose(self.support).position_m
        landing_m = footing[self.support].plane.height_beside(way_m, slope)
        return landing_m - footing[self.side].plane.height_m


class LandingPlan:
    """
    The landing of a step, and the plan of the DCM from the start of the step until rest.

    Parameters
    ----------
    context
        Context shared by the phases of the gait.
    support
        Side of the foot that carries the robot.
    shift_s
        Duration of double support at the start.
    zmp
        Zero-moment point in use at the start (m), in the odom frame.

    Attributes
    ----------
    pose
        Pose at which the swing foot lands, in the odom frame.

    """

    def __init__(self, context: GaitContext, support: int, shift_s: float, zmp: Point) -> None:
        self._context = context
        self._support, self._shift_s, self._start_m = support, shift_s, zmp
        self._adjuster = StepAdjuster(context.planner, context.pendulum.rate_1_s)
        self.restart(self.next_pose())

    @property
    def footsteps(self) -> list[Footstep]:
        """Return the planned footsteps, this one first."""
        return self._context.footsteps(self.pose, self._support)

    def next_pose(self) -> PlanarPose:
        """Plan a landing, corrected to the reference path unless the robot stops."""
        planner, support = self._context.planner, self._context.footing.pose(self._support)
        start = planner.middle_beside(support, self._support)
        if not self._context.is_stopping:
            start = self._context.path.corrected(start)
        goal = planner.next_middle(start, self._support, self._context.velocity)
        landing = planner.landing(support, self._support, goal)
        return PlanarPose(self._context.guard.kept_off(landing.position_m), landing.yaw_rad)

    def restart(self, nominal: PlanarPose) -> None:
        """
        Plan anew for another nominal landing.

        Parameters
        ----------
        nominal
            Pose of the landing as long as the DCM has no error, in the odom frame.

        """
        self._is_for_stop = self._context.is_stopping
        self._nominal = self.pose = nominal
        self._nominal_plan = self._plan = self._planned(nominal)

    def move(self, pose: PlanarPose) -> None:
        """
        Land elsewhere than at the nominal landing.

        Parameters
        ----------
        pose
            Pose of the landing, in the odom frame.

        """
        self.pose = pose
        self._plan = self._planned(pose)

    def heed_stop(self) -> None:
        """Replan the DCM when the robot has started to stop, or no longer stops."""
        if self._context.is_stopping != self._is_for_stop:
            self._is_for_stop = self._context.is_stopping
            self._nominal_plan = self._planned(self._nominal)
            self._plan = self._planned(self.pose)

    def at(self, time_s: float) -> BalanceReference:
        """
        Evaluate the plan.

        Parameters
        ----------
        time_s
            Time on the clock of the step.

        """
        return self._plan.at(time_s)

    def adjust(self, dcm: Point, sides: tuple[int, ...], time_s: float, clock: StepClock) -> None:
        """
        Adjust the position and the timing of the landing to the error of the DCM.

        Parameters
        ----------
        dcm
            Divergent component of motion (m), in the odom frame.
        sides
            Sides of the feet that carry the robot.
        time_s
            Time at which the plan is evaluated, on the clock.
        clock
            Clock of the step, whose rate is set.

        """
        support = self._context.footing.pose(self._support)
        residual = Residual.of(
            self._nominal_plan.at(time_s),
            dcm,
            self._context.parameters.balance.dcm_gain,
            self._context.footing.polygon(sides),
            support,
        )
        adjustment = self._adjuster.adjusted(
            self._nominal,
            support,
            self._support,
            residual,
            clock.end_s - time_s,
            clock.rate,
        )
        clock.rate = adjustment.rate
        if adjustment.landing != self.pose:
            self.move(adjustment.landing)

    def _planned(self, landing: PlanarPose) -> DcmPlan:
        """Plan the DCM from the start of the step until the robot rests, for a landing."""
        steps = self._context.footsteps(landing, self._support)
        return self._context.plan(
            self._context.step_segments(self._support, steps, self._start_m, self._shift_s)
        )
