# SPDX-License-Identifier: Apache-2.0
"""When and where a step lands: its clock, its landing, and the plan of the DCM for that."""

from __future__ import annotations

from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gait_context import GaitContext
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import BalanceReference, DcmPlan
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.step_adjustment import Residual, StepAdjuster


class StepClock:
    """
    Clock of a step, which may run faster than real time to catch the robot.

    Parameters
    ----------
    parameters : WalkParameters
        Gait parameters.
    shift_s
        Duration of double support, in which the weight shifts to the support foot.

    Attributes
    ----------
    elapsed_s, rate
        Time on this clock, and its rate relative to real time.
    passed_s
        Real time for which the swing foot moves in this control period.

    """

    def __init__(self, parameters: WalkParameters, shift_s: float) -> None:
        self._parameters = parameters
        self.shift_s = shift_s
        self.passed_s = 0.0
        self._real_s = 0.0
        self.elapsed_s = 0.0
        self.rate = 1.0

    @property
    def end_s(self) -> float:
        """Return the planned time of the landing, on this clock."""
        return self.shift_s + self._parameters.timing.swing_s

    @property
    def adjustable_until_s(self) -> float:
        """Return the time from which the landing no longer changes, on this clock."""
        return self.end_s - self._parameters.step_adjustment.until_s

    @property
    def duration_s(self) -> float:
        """Return the actual duration, with the weight shift counted at its regular duration."""
        return self._real_s + self._parameters.timing.shift_s - self.shift_s

    @property
    def in_air_s(self) -> float:
        """Return the time since the planned lift-off, on this clock; negative before it."""
        return self.elapsed_s - self.shift_s

    @property
    def swing_phase(self) -> float:
        """Return the phase of the swing: 0 in double support, 1 at its end, above 1 if late."""
        return max(0.0, self.in_air_s) / self._parameters.timing.swing_s

    @property
    def arrival_s(self) -> float:
        """Return the real time until the foot is above its landing."""
        p = self._parameters
        return (p.swing.early_arrival * p.timing.swing_s - self.in_air_s) / self.rate

    @property
    def is_late(self) -> bool:
        """Whether the landing is overdue."""
        return self.elapsed_s > self.end_s + self._parameters.swing.late_touchdown_s

    def advance(self, passed_s: float, *, waits: bool) -> None:
        """
        Advance the clock by one control period.

        Parameters
        ----------
        passed_s
            Time since the last control period.
        waits
            Whether it waits for the swing foot after a gap in control.

        """
        before_s = self.elapsed_s
        self.passed_s = min(passed_s, self._parameters.swing.longest_tick_s)
        self._real_s += passed_s
        self.elapsed_s += passed_s * self.rate
        if waits:
            in_air_s = before_s + self.passed_s * self.rate
            self.elapsed_s = min(self.elapsed_s, max(self.shift_s, in_air_s))


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
