# SPDX-License-Identifier: Apache-2.0
"""A step: the weight shifts to one foot, and the other one swings to its landing."""

from __future__ import annotations

from humanoid_control.walking.footing import Foothold, SoleReading
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gait_context import GaitContext, GaitInput
from humanoid_control.walking.landing import LandingPlan
from humanoid_control.walking.obstacle_guard import LegInAir
from humanoid_control.walking.pendulum import BalanceReference
from humanoid_control.walking.planar import (
    GroundPlane,
    other,
    PlanarPose,
    Point,
    SIDES,
    smooth_turn,
    Turning,
)
from humanoid_control.walking.swing_foot import Lift, SoleMotion, StepClock, Swing, SwingFoot

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
        self._foot = SwingFoot(self._lift_off)
        p = context.parameters
        self._lift = Lift(
            p.swing.height_m, p.timing.swing_s, p.swing.reach_down_m_s, p.swing.deepest_m
        )
        self._tilt = context.slope
        self._has_touched = False
        self._lost_s = 0.0
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

    def advance(self, passed_s: float) -> None:
        """
        Advance the clock of the step by one control period.

        During a gap in control the swing foot received no targets. It must not rush to catch up:
        the step waits for it.

        Parameters
        ----------
        passed_s
            Time since the last control period.

        """
        self._clock.advance(passed_s, waits=not self._has_touched)

    def replan(self, now: GaitInput) -> None:
        """
        Replan the landing for a velocity that has changed abruptly.

        Once the foot has touched the ground, or shortly before its landing, nothing changes.

        Parameters
        ----------
        now
            As for `Phase.replan`.

        """
        if self._has_touched or self._clock.elapsed_s > self._clock.adjustable_until_s:
            return
        blockage = self._context.guard.blockage
        if blockage and blockage.leg is not None:
            # The foot is not where it was planned to be.
            self._foot = SwingFoot(now.soles[self.side].pose)
        self._landing.restart(self._in_time(self._landing.next_pose()))

    def _in_time(self, landing: PlanarPose) -> PlanarPose:
        """Limit a landing to what the foot can reach in time: a faster swing topples the robot."""
        if self._clock.swing_phase <= 0.0:
            return landing
        start_m = self._foot.pose.position_m
        way_m = landing.position_m - start_m
        most_m = self._context.parameters.obstacles.turn_back_m_s * max(0.0, self._clock.arrival_s)
        if abs(way_m) <= most_m:
            return landing
        return PlanarPose(start_m + way_m * (most_m / abs(way_m)), landing.yaw_rad)

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
            and not self._has_touched
        )
        if not swings or sole.load > p.swing.touch_load:
            return None
        return LegInAir(self.side, now.touch.legs_nm[self.side], sole.pose.position_m)

    def feel(self, now: GaitInput) -> None:
        """
        Detect the touchdown of the swing foot, early or late, and the loss of that contact.

        The foot stays where it touches the ground until the step ends. A contact that is lost was
        not the ground: it gave way, or the foot only grazed it, and the swing resumes.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.

        """
        sole = now.soles[self.side]
        if self._has_touched:
            self._notice_loss(sole, now.passed_s)
            return
        if now.passed_s > self._clock.passed_s and self._clock.swing_phase > 0.0:
            self._foot = SwingFoot(sole.pose)
        if not (self._touches(sole) or self._clock.is_late):
            return
        self._has_touched = True
        plane = GroundPlane(sole.plane.height_m, self._tilt)
        self._context.footing.put(self.side, Foothold(sole.pose, plane))

    def _notice_loss(self, sole: SoleReading, passed_s: float) -> None:
        """Resume the swing if the foot loses contact before its planned landing."""
        p = self._context.parameters
        bears = sole.load > p.swing.lost_load or self._clock.swing_phase > 1.0
        self._lost_s = 0.0 if bears else self._lost_s + passed_s
        if self._lost_s < p.swing.lost_s:
            return
        self._has_touched, self._lost_s = False, 0.0
        self._context.footing.put(self.side, self._lifted_from)
        self._foot = SwingFoot(sole.pose)
        if self._clock.arrival_s < p.swing.least_s:
            self._landing.move(sole.pose)

    def has_landed(self, now: GaitInput) -> bool:
        """
        Check whether the foot can take the weight, or its landing is overdue.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.

        """
        p, phase = self._context.parameters, self._clock.swing_phase
        bears = now.soles[self.side].load > p.swing.touchdown_load or phase > 1.0
        return self._clock.is_late or (
            self._has_touched and phase > p.swing.landing_phase and bears
        )

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
        clock, foot = self._clock, self._foot
        if clock.in_air_s <= 0.0 or self._has_touched:
            return None
        passed_s = min(clock.passed_s, clock.in_air_s / clock.rate)
        foot.advance(self._landing.pose, clock.arrival_s + passed_s, passed_s)
        start, rise_m = self._context.footing[self.side].plane, self._rise_m
        height_m, climb_m_s, climb_m_s2 = self._lift.at(clock.in_air_s, rise_m)
        share = min(1.0, clock.swing_phase)
        self._tilt = start.tilt + share * (self._context.slope - start.tilt)
        motion = SoleMotion(
            foot.pose,
            GroundPlane(start.height_m + height_m, self._tilt),
            foot.velocity_m_s,
            climb_m_s * clock.rate,
            foot.turn_rad_s,
            foot.acceleration_m_s2,
            climb_m_s2 * clock.rate**2,
            foot.turn_rad_s2,
        )
        return Swing(self.side, motion)

    @property
    def _rise_m(self) -> float:
        """Return the expected height of the ground at the landing above that at the lift-off."""
        footing, slope = self._context.footing, self._context.slope
        way_m = self._landing.pose.position_m - footing.pose(self.support).position_m
        landing_m = footing[self.support].plane.height_beside(way_m, slope)
        return landing_m - footing[self.side].plane.height_m

    def _touches(self, sole: SoleReading) -> bool:
        """Detect contact of the descending foot with the ground."""
        p, phase = self._context.parameters, self._clock.swing_phase
        enough = p.swing.touch_load if phase > p.swing.gentle_phase else p.swing.touchdown_load
        # Friction on the front of an obstacle is not ground contact.
        is_below = abs(sole.drag) < sole.load
        return phase > p.swing.touchdown_phase and sole.load > enough and is_below
