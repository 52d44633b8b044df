# SPDX-License-Identifier: Apache-2.0
"""
How a step catches the robot: its landing is moved, or hurried, by the error of the DCM.

The error of the divergent component of motion (DCM) that the feet on the ground cannot correct
grows until the end of the step, and the landing has to move by as much (the capture point). If
that is out of reach, the step is hurried: the error grows for a shorter time. After M. Khadiv et
al., "Walking control based on step timing adaptation", IEEE Transactions on Robotics 36(3), 2020.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass
import math

from humanoid_control.walking.footsteps import FootstepPlanner
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import BalanceReference
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.support_polygon import SupportPolygon

_UNTOUCHED_M = 1e-6


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
