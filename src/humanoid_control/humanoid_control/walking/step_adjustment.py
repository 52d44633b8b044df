# SPDX-License-Identifier: Apache-2.0
"""
Where and when a step has to land to catch the robot.

What the feet on the ground cannot take out of the error of the divergent component grows until
the end of the step, and the landing has to move as far (the capture point). If that is out of
reach, the step is hurried: the error grows for a shorter time. After M. Khadiv et al., "Walking
control based on step timing adaptation", IEEE Transactions on Robotics 36(3), 2020.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass
import math

from humanoid_control.walking.dcm_plan import BalanceReference
from humanoid_control.walking.footsteps import FootstepPlanner
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.support_polygon import SupportPolygon

_UNTOUCHED_M = 1e-6


@dataclass(frozen=True)
class Adjustment:
    """A landing, and how much faster than planned the step goes."""

    landing: PlanarPose
    rate: float


@dataclass(frozen=True)
class StepAdjuster:
    """Moves and hurries landings."""

    planner: FootstepPlanner
    rate_1_s: float

    @property
    def parameters(self) -> WalkParameters:
        """Return the gait."""
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
        Adjust where and when a step lands so that it catches the robot.

        Parameters
        ----------
        nominal
            Where the foot lands by plan, in the odom frame.
        support, side
            The pose of the foot that carries the robot, in the odom frame, and its side.
        residual
            The error of the DCM, and what the ZMP does against it.
        remaining_s
            The time to the end of the step, as planned.
        rate
            How many times faster than planned the step runs already; it is never slowed down.

        Returns
        -------
        Adjustment
            The landing in the odom frame, within reach and with the planned heading, and the rate
            of the step.

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
        """Tell whether little had to be cut."""
        cut, p = wanted - reached, self.parameters
        return (
            abs(cut.real) < p.step_adjustment.unreachable_length_m
            and abs(cut.imag) < p.step_adjustment.unreachable_width_m
        )

    def _calls_for_hurry(self, residual: Residual) -> bool:
        """Tell whether the robot is so far off that a step may be hurried."""
        return abs(residual.error_m) >= self.parameters.step_adjustment.hurry_error_m


@dataclass(frozen=True)
class Residual:
    """The error of the divergent component, and what the zero-moment point does against it."""

    error_m: Point
    wanted_m: Point
    """The shift of the zero-moment point that feedback asks for; all seen from the support."""
    shift_m: Point
    """The shift that the feet on the ground allow."""
    yaw_rad: float
    """How the support is turned."""

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
        Compute the error of the DCM, and the shift of the ZMP against it.

        Parameters
        ----------
        reference
            Where DCM and ZMP should be, in the plane of the odom frame (m).
        dcm
            The divergent component of motion, in the same plane (m).
        gain
            How far the ZMP goes for each metre of the error.
        polygon
            Where the feet on the ground allow the ZMP to be.
        support
            The pose of the foot that carries the robot, in the odom frame.

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
            The factor by which an error that nothing counters grows until the landing.
        parameters : WalkParameters
            The gait, which has the dead band.

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
    """Return what an axis leaves to the landing: nothing while the feet do all that is wanted."""
    if abs(wanted) <= abs(shift) + _UNTOUCHED_M:
        return 0.0
    return math.copysign(max(0.0, abs(left) - dead_band), left)
