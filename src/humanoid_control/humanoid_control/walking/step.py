# SPDX-License-Identifier: Apache-2.0
"""A step: the weight goes to one foot, and the other one swings to where it lands."""

from __future__ import annotations

from humanoid_control.walking.dcm_plan import BalanceReference, DcmPlan
from humanoid_control.walking.footing import Foothold
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gear import GaitInput, Gear
from humanoid_control.walking.planar import limited, PlanarPose, Point
from humanoid_control.walking.sides import other, SIDES
from humanoid_control.walking.step_adjustment import Residual
from humanoid_control.walking.swing_foot import Lift, SoleMotion, Swing, SwingFoot
from humanoid_control.walking.turning import smooth_turn, Turning

_INSTANT_S = 1e-4
"""The plan is asked for a moment before the end of a step until the foot has landed."""


class Step:
    """The step that is under way, with a clock that may run faster to catch the robot."""

    def __init__(self, gear: Gear, support: int, shift_s: float, zmp: Point) -> None:
        """Begin on both feet with the zero-moment point in use."""
        self._gear = gear
        self.support = support
        self.side = other(support)
        self._shift_s = shift_s
        self._start_m = zmp
        self._passed_s = 0.0
        self._real_s = 0.0
        self.elapsed_s = 0.0
        self.rate = 1.0
        self.error_m = 0.0
        self._lift_off = gear.footing.pose(self.side)
        self._foot = SwingFoot(self._lift_off)
        p = gear.parameters
        self._lift = Lift(p.swing_height_m, p.swing_s, p.reach_down_m_s)
        self._nominal = self._next_landing()
        self._planned_for = gear.is_stopping
        self._nominal_plan = self._planned(self._nominal)
        self._plan = self._nominal_plan
        self.landing = self._nominal

    @property
    def end_s(self) -> float:
        """Return the time at which the foot lands by plan."""
        return self._shift_s + self._gear.parameters.swing_s

    @property
    def duration_s(self) -> float:
        """Return how long it has taken in fact, apart from a longer or shorter begin."""
        return self._real_s + self._gear.parameters.shift_s - self._shift_s

    @property
    def swing_phase(self) -> float:
        """Return which share of the swing has passed: 0 on both feet, above 1 if it is late."""
        return max(0.0, self.elapsed_s - self._shift_s) / self._gear.parameters.swing_s

    @property
    def sides(self) -> tuple[int, ...]:
        """Return the sides whose feet carry the robot."""
        return SIDES if self.elapsed_s < self._shift_s else (self.support,)

    @property
    def footsteps(self) -> list[Footstep]:
        """Return the steps that are planned, this one first."""
        return self._gear.footsteps(self.landing, self.support)

    def advance(self, passed_s: float) -> None:
        """Let time pass."""
        self._passed_s = passed_s
        self._real_s += passed_s
        self.elapsed_s += passed_s * self.rate

    def has_landed(self, now: GaitInput) -> bool:
        """Tell whether the foot stands, or should have stood long ago."""
        p, sole = self._gear.parameters, now.soles[self.side]
        touches = (
            self.swing_phase > p.touchdown_phase
            and sole.load > p.touchdown_load
            and sole.height_m < p.touchdown_height_m
        )
        return touches or self.elapsed_s > self.end_s + p.late_touchdown_s

    def foothold(self, now: GaitInput) -> Foothold:
        """Return where the foot has landed."""
        sole, most_m = now.soles[self.side], self._gear.parameters.touchdown_height_m
        return Foothold(sole.pose, limited(sole.height_m, -most_m, most_m))

    def reference(self, now: GaitInput) -> BalanceReference:
        """Return where the divergent component and the zero-moment point should be now."""
        self._replan_if_stopping_changed()
        time_s = min(self.elapsed_s, self.end_s - _INSTANT_S)
        if self.elapsed_s < self.end_s - self._gear.parameters.adjust_until_s:
            self._adjust(now, time_s)
        reference = self._plan.at(time_s)
        self.error_m = abs(now.dcm_m - reference.dcm_m)
        return reference

    @property
    def turning(self) -> Turning:
        """Return the mean heading of the feet on its way from lift-off to landing."""
        support = self._gear.footing.pose(self.support)
        before, after = support.halfway(self._lift_off), support.halfway(self.landing)
        turning = smooth_turn(before.yaw_rad, after.yaw_rad, self.elapsed_s, self.end_s)
        return Turning(turning.heading_rad, turning.rate_rad_s * self.rate)

    def swing(self) -> Swing | None:
        """Return where the sole in the air is to be; to be asked once a tick."""
        p, in_air_s = self._gear.parameters, self.elapsed_s - self._shift_s
        if in_air_s <= 0.0:
            return None
        passed_s = min(self._passed_s, in_air_s / self.rate)
        remaining_s = (p.early_arrival * p.swing_s - in_air_s) / self.rate + passed_s
        foot = self._foot
        foot.advance(self.landing, remaining_s, passed_s)
        height_m, climb_m_s, climb_m_s2 = self._lift.at(in_air_s)
        motion = SoleMotion(
            foot.pose,
            height_m,
            foot.velocity_m_s,
            climb_m_s * self.rate,
            foot.turn_rad_s,
            foot.acceleration_m_s2,
            climb_m_s2 * self.rate**2,
            foot.turn_rad_s2,
        )
        return Swing(self.side, motion)

    def _next_landing(self) -> PlanarPose:
        """Return where the foot lands by plan, on the robot's course unless it stops."""
        planner, support = self._gear.planner, self._gear.footing.pose(self.support)
        start = planner.middle_beside(support, self.support)
        if not self._gear.is_stopping:
            start = self._gear.course.corrected(start)
        goal = planner.next_middle(start, self.support, self._gear.command)
        return planner.landing(support, self.support, goal)

    def _planned(self, landing: PlanarPose) -> DcmPlan:
        """Return the plan from the begin of the step to rest for a landing."""
        steps = self._gear.footsteps(landing, self.support)
        return self._gear.plan(
            self._gear.step_segments(self.support, steps, self._start_m, self._shift_s)
        )

    def _replan_if_stopping_changed(self) -> None:
        """Plan the rest of the way anew when it has become the last step, or no longer is."""
        if self._gear.is_stopping != self._planned_for:
            self._planned_for = self._gear.is_stopping
            self._nominal_plan = self._planned(self._nominal)
            self._plan = self._planned(self.landing)

    def _adjust(self, now: GaitInput, time_s: float) -> None:
        """Move and hurry the landing as far as the robot needs it."""
        support = self._gear.footing.pose(self.support)
        residual = Residual.of(
            self._nominal_plan.at(time_s),
            now.dcm_m,
            self._gear.parameters.dcm_gain,
            self._gear.footing.polygon(self.sides),
            support,
        )
        adjustment = self._gear.adjuster.adjusted(
            self._nominal, support, self.support, residual, self.end_s - time_s, self.rate
        )
        self.rate = adjustment.rate
        if adjustment.landing != self.landing:
            self.landing = adjustment.landing
            self._plan = self._planned(self.landing)
