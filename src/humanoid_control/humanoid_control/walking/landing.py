# SPDX-License-Identifier: Apache-2.0
"""
Where a step lands: the plan of its landing and of the DCM, and the adjustment to errors.

The error of the divergent component of motion (DCM) that the feet on the ground cannot correct
grows until the end of the step, and the landing has to move by as much (the capture point). If
that is out of reach, the step is hurried: the error grows for a shorter time. After M. Khadiv et
al., "Walking control based on step timing adaptation", IEEE Transactions on Robotics 36(3), 2020.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass
import math

from humanoid_control.walking.footsteps import Footstep, FootstepPlanner
from humanoid_control.walking.gait_context import GaitContext
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import BalanceReference, DcmPlan
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.support_polygon import SupportPolygon
from humanoid_control.walking.swing_foot import StepClock

_UNTOUCHED_M = 1e-6


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


@dataclass(frozen=True)
class Adjustment:
    """Adjusted landing, and the rate of the step relative to the plan."""

    landing: PlanarPose
    rate: float


@dataclass(frozen=True)
class StepAdjuster:
    """Adjusts the position and the timing of landings to the error of the DCM."""

    planner: FootstepPlanner
    rate_1_s: float

    @property
    def parameters(self) -> WalkParameters:
        """Return the gait parameters."""
        return self.planner.parameters

    def adjusted(
        self,
        nominal: PlanarPose,
        support: PlanarPose,
        side: int,
        residual: Residual,
        remaining_s: float,
        rate: float,
    ) -> Adjustment:
        """
        Adjust the position and the timing of a landing so that the step catches the robot.

        Parameters
        ----------
        nominal
            Planned pose of the landing, in the odom frame.
        support, side
            Pose of the foot that carries the robot, in the odom frame, and its side.
        residual
            Error of the DCM, and the shift of the ZMP that counters it.
        remaining_s
            Time to the planned end of the step, on its own clock.
        rate
            Present rate of the step relative to the plan; it is never reduced.

        Returns
        -------
        Adjustment
            Landing in the odom frame, within reach and with the planned heading, and the rate of
            the step.

        """
        for rate in (r for r in self.parameters.step_adjustment.hurry_rates if r >= rate):
            growth = math.exp(self.rate_1_s * remaining_s / rate)
            wanted = nominal.moved(residual.at_landing(growth, self.parameters))
            place = support.local(wanted.position_m)
            reached = self.planner.reachable(place, side)
            if self._is_near(place, reached) or not self._calls_for_hurry(residual):
                break
        landing = PlanarPose(support.at(reached.real, reached.imag), nominal.yaw_rad)
        return Adjustment(landing, rate)

    def _is_near(self, wanted: Point, reached: Point) -> bool:
        """Check whether the reachable landing is close enough to the wanted one."""
        cut, p = wanted - reached, self.parameters
        return (
            abs(cut.real) < p.step_adjustment.unreachable_length_m
            and abs(cut.imag) < p.step_adjustment.unreachable_width_m
        )

    def _calls_for_hurry(self, residual: Residual) -> bool:
        """Check whether the error of the DCM is so large that a step may be hurried."""
        return abs(residual.error_m) >= self.parameters.step_adjustment.hurry_error_m


@dataclass(frozen=True)
class Residual:
    """Error of the DCM and the ZMP shift that counters it, in the axes of the support foot."""

    error_m: Point
    wanted_m: Point
    """Shift of the zero-moment point that feedback asks for."""
    shift_m: Point
    """Shift that the feet on the ground allow."""
    yaw_rad: float
    """Heading of the support foot."""

    @classmethod
    def of(
        cls,
        reference: BalanceReference,
        dcm: Point,
        gain: float,
        polygon: SupportPolygon,
        support: PlanarPose,
    ) -> Residual:
        """
        Compute the error of the DCM, and the shift of the ZMP that counters it.

        Parameters
        ----------
        reference
            Reference of DCM and ZMP, in the plane of the odom frame (m).
        dcm
            Divergent component of motion, in the same plane (m).
        gain
            Shift of the ZMP for each metre of the error.
        polygon
            Support polygon of the feet on the ground, which limits the ZMP.
        support
            Pose of the foot that carries the robot, in the odom frame.

        Returns
        -------
        Residual
            All in the axes of the support foot.

        """
        turn = cmath.rect(1.0, -support.yaw_rad)
        error = dcm - reference.dcm_m
        shift = polygon.clamped(reference.zmp_m + gain * error) - reference.zmp_m
        return cls(error * turn, gain * error * turn, shift * turn, support.yaw_rad)

    def at_landing(self, growth: float, parameters: WalkParameters) -> Point:
        """
        Predict the part of the DCM error at the landing that the foothold has to make up for.

        Parameters
        ----------
        growth
            Factor by which an uncorrected error grows until the landing.
        parameters : WalkParameters
            Gait parameters, with the dead band.

        Returns
        -------
        Point
            What exceeds the dead band, in m, in the axes of the odom frame. Along an axis of the
            support foot on which the feet do all that feedback asks for, it is zero.

        """
        left = self.error_m * growth - self.shift_m * (growth - 1.0)
        dead_band_m = parameters.step_adjustment.dead_band_m
        return cmath.rect(1.0, self.yaw_rad) * complex(
            _beyond(left.real, self.wanted_m.real, self.shift_m.real, dead_band_m),
            _beyond(left.imag, self.wanted_m.imag, self.shift_m.imag, dead_band_m),
        )


def _beyond(left: float, wanted: float, shift: float, dead_band: float) -> float:
    """Compute the error that an axis leaves to the landing; zero while the ZMP suffices."""
    if abs(wanted) <= abs(shift) + _UNTOUCHED_M:
        return 0.0
    return math.copysign(max(0.0, abs(left) - dead_band), left)
