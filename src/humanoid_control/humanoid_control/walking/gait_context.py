# SPDX-License-Identifier: Apache-2.0
"""Interface of the phases of the gait, with their input, their output and their shared context."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

from humanoid_control.walking.commands import (
    largest_change,
    STANDING,
    VelocityCommand,
    VelocityLimits,
)
from humanoid_control.walking.footing import Footing, SoleReading
from humanoid_control.walking.footsteps import Footstep, FootstepPlanner, ReferencePath
from humanoid_control.walking.obstacle_guard import (
    ExternalForces,
    LegInAir,
    NOTHING,
    ObstacleGuard,
    Touch,
)
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import BalanceReference, DcmPlan, Pendulum, ZmpSegment
from humanoid_control.walking.planar import PlanarPose, Point, SIDES, Turning
from humanoid_control.walking.swing_foot import Swing


@dataclass(frozen=True)
class GaitInput:
    """Estimates, measurements and velocity command of a control period."""

    passed_s: float
    """Time since the last control period."""
    dcm_m: Point
    zmp_m: Point
    """Zero-moment point in use, as commanded in the last control period."""
    soles: tuple[SoleReading, SoleReading]
    velocity: VelocityCommand = STANDING
    """Commanded velocity in the axes of the robot, before it is clamped to the limits."""
    error_m: Point = 0j
    """Error of the divergent component of motion in the last control period."""
    force_n: Point = 0j
    """Horizontal external force on the robot, other than at its feet."""
    touch: Touch = NOTHING


@dataclass(frozen=True)
class GaitOutput:
    """Output of the gait in a control period."""

    reference: BalanceReference
    zmp_m: Point
    """Zero-moment point with feedback, within the support polygon."""
    turning: Turning
    """Target heading of the pelvis."""
    swing: Swing | None
    sides: tuple[int, ...]
    """Sides of the feet that carry the robot."""


class Phase(Protocol):
    """Interface of a phase of the gait."""

    @property
    def name(self) -> str:
        """Return the name shown to users."""

    @property
    def sides(self) -> tuple[int, ...]:
        """Return the sides of the feet that carry the robot."""

    @property
    def turning(self) -> Turning:
        """Return the target heading of the pelvis."""

    @property
    def footsteps(self) -> Sequence[Footstep]:
        """Return the planned footsteps."""

    def replan(self, now: GaitInput) -> None:
        """
        Replan for a velocity that has changed abruptly.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.

        """

    def leg_in_air(self, now: GaitInput) -> LegInAir | None:
        """
        Get the leg that swings freely, and the push on it.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.

        Returns
        -------
        LegInAir or None
            None unless a foot is in the air that only an obstacle can push.

        """

    def advance(self, now: GaitInput) -> Phase:
        """
        Advance the gait by one control period.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.

        Returns
        -------
        Phase
            The present phase: this one or its successor.

        """

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of the DCM and of the ZMP; call it after `advance`.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.

        Returns
        -------
        BalanceReference
            Both points in the plane of the odom frame, in m.

        """

    def swing(self) -> Swing | None:
        """Compute the swing foot target, or None without one; call it once per control period."""


@dataclass
class GaitContext:
    """Context shared by the phases of the gait: parameters, planners, footholds and velocity."""

    parameters: WalkParameters
    pendulum: Pendulum
    footing: Footing
    target: VelocityCommand = STANDING
    """What obstacles allow of the commanded velocity, or that of a retreat."""
    velocity: VelocityCommand = STANDING
    """Present velocity, which approaches the target."""
    slope: Point = 0j
    """Expected tilt of the ground ahead."""
    planner: FootstepPlanner = field(init=False)
    path: ReferencePath = field(init=False)
    guard: ObstacleGuard = field(init=False)
    limits: VelocityLimits = field(init=False)

    def __post_init__(self) -> None:
        self.planner = FootstepPlanner(self.parameters)
        self.path = ReferencePath(self.planner)
        self.guard = ObstacleGuard(self.parameters)
        self.limits = VelocityLimits.of(self.parameters.velocity)

    def heed_obstacles(self, now: GaitInput, leg: LegInAir | None) -> bool:
        """
        Set the target velocity to what obstacles allow of the commanded one, or to a retreat.

        At a new obstacle the present velocity becomes zero and the reference path restarts.

        Parameters
        ----------
        now
            Estimates and measurements of this control period.
        leg
            Swing leg whose contacts count; None without one.

        Returns
        -------
        bool
            Whether a new obstacle was detected.

        """
        left, right = (self.planner.middle_beside(self.footing.pose(side), side) for side in SIDES)
        wanted = self.limits.applied(now.velocity)
        going = self.velocity if self.velocity.linear_m_s else wanted
        contact = ExternalForces(now.force_n, now.touch.arms_nm, leg)
        met = self.guard.update(contact, (left, right), wanted, going, now.error_m, now.passed_s)
        self.target = self.limits.applied(self.guard.allowed(wanted, left.halfway(right).yaw_rad))
        if met:
            self.velocity = STANDING
            self.path.restart()
        return met

    def approach_target(self, time_s: float) -> None:
        """
        Accelerate towards the target velocity, within the acceleration limits.

        Parameters
        ----------
        time_s
            Duration over which to accelerate: a control period, or a step.

        """
        most = largest_change(self.parameters.velocity, time_s)
        self.velocity = self.velocity.towards(self.target, most)

    def learn_slope(self, tilt: Point) -> None:
        """
        Low-pass filter the ground slope measured at a foothold.

        Parameters
        ----------
        tilt
            Horizontal part of the unit normal of the ground under the foot, in the odom frame.

        """
        self.slope += self.parameters.terrain.slope_share * (tilt - self.slope)

    @property
    def is_stopping(self) -> bool:
        """Whether the robot stops as soon as its feet are side by side."""
        return self.velocity.is_zero and self.target.is_zero

    def plan(self, segments: list[ZmpSegment]) -> DcmPlan:
        """
        Compute the DCM trajectory that belongs to a ZMP trajectory.

        Parameters
        ----------
        segments
            ZMP trajectory (m) in the odom frame; it ends where the robot comes to rest.

        Raises
        ------
        WalkingError
            There are no segments.

        """
        return DcmPlan(segments, self.pendulum.rate_1_s)

    def footsteps(self, landing: PlanarPose, support: int) -> list[Footstep]:
        """
        Plan the footsteps from the one in progress until the robot rests.

        Parameters
        ----------
        landing
            Pose at which the swing foot lands, in the odom frame.
        support
            Side of the foot that carries the robot.

        Returns
        -------
        list of Footstep
            The step in progress and those that follow, at most `preview_steps` in total.

        """
        steps: list[Footstep] = []
        before = Footstep(support, self.footing.pose(support))
        for step in self.planner.footsteps(landing, support, self.velocity):
            steps.append(step)
            rests = self.is_stopping and self.planner.is_parallel(
                before.pose, before.side, step.pose
            )
            if rests or len(steps) == self.parameters.footsteps.preview_steps:
                return steps
            before = step
        return steps

    def step_segments(
        self, support: int, steps: list[Footstep], start_m: Point, shift_s: float
    ) -> list[ZmpSegment]:
        """
        Compute the ZMP trajectory from the start of a step until the robot rests.

        Parameters
        ----------
        support
            Side of the foot that carries the robot during the step.
        steps
            Planned footsteps, from this one on; at least one.
        start_m
            Zero-moment point at the start of the step, in the odom frame.
        shift_s
            Duration of the weight shift to the support foot.

        Returns
        -------
        list of ZmpSegment
            Trajectory in the odom frame; it ends in the middle between the load points of the last
            two footholds.

        """
        p, load = self.parameters, self.footing.load_point(support)
        segments = [
            ZmpSegment(shift_s, start_m, load),
            ZmpSegment(p.timing.swing_s, load, load),
        ]
        for step in steps[:-1]:
            next_load = self.footing.load_point(step.side, step.pose)
            segments.append(ZmpSegment(p.timing.shift_s, load, next_load))
            segments.append(ZmpSegment(p.timing.swing_s, next_load, next_load))
            load = next_load
        last_load = self.footing.load_point(steps[-1].side, steps[-1].pose)
        segments.append(ZmpSegment(p.timing.stop_s, load, (load + last_load) / 2))
        return segments
