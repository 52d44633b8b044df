# SPDX-License-Identifier: Apache-2.0
"""The phases of the gait: the robot stands, steps, or comes to rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from humanoid_control.walking.dcm_plan import BalanceReference, ZmpSegment
from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gait_context import GaitContext, GaitInput
from humanoid_control.walking.obstacle_guard import LegInAir
from humanoid_control.walking.planar import PlanarPose, Point
from humanoid_control.walking.sides import LEFT, RIGHT, SIDES
from humanoid_control.walking.step import Step
from humanoid_control.walking.swing_foot import Swing
from humanoid_control.walking.turning import Turning

STAND = 'stand'
"""The name of the phase in which nothing moves."""
_SETTLED_S = 0.3
"""A robot that just begins to stand does not step against pushes yet."""
_REST_S = 0.1
"""How long it waits at the end of coming to rest."""
_RESUMABLE = 0.5
"""Until which share of coming to rest it may walk on."""


class Phase(Protocol):
    """A part of the gait."""

    @property
    def name(self) -> str:
        """Return what users call it."""

    @property
    def sides(self) -> tuple[int, ...]:
        """Return the sides whose feet carry the robot."""

    @property
    def turning(self) -> Turning:
        """Return where the pelvis is to face."""

    @property
    def footsteps(self) -> Sequence[Footstep]:
        """Return the steps that are planned."""

    def replan(self, now: GaitInput) -> None:
        """
        Replan for a velocity that has changed abruptly.

        Parameters
        ----------
        now
            What the gait knows of the robot at this tick.

        """

    def leg_in_air(self, now: GaitInput) -> LegInAir | None:
        """
        Get the leg that swings freely, and what pushes it.

        Parameters
        ----------
        now
            What the gait knows of the robot at this tick.

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
            What the gait knows of the robot at this tick.

        Returns
        -------
        Phase
            The phase from now on: this one or one that follows.

        """

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of the DCM and of the ZMP; call it after `advance`.

        Parameters
        ----------
        now
            What the gait knows of the robot at this tick.

        Returns
        -------
        BalanceReference
            Both points in the plane of the odom frame, in m.

        """

    def swing(self) -> Swing | None:
        """Compute the swing foot target, or None without one; call it once per control period."""


class _OnBothFeet:
    """What standing and coming to rest have in common."""

    sides: tuple[int, ...] = SIDES
    footsteps: Sequence[Footstep] = ()

    def __init__(self, context: GaitContext) -> None:
        """Begin now."""
        self._context = context
        self._elapsed_s = 0.0

    @property
    def turning(self) -> Turning:
        """Return the mean heading of the feet."""
        return Turning(self._context.footing.middle.yaw_rad)

    def swing(self) -> Swing | None:
        """Return that no foot swings."""
        return None

    def replan(self, now: GaitInput) -> None:
        """Do nothing: where the weight goes does not depend on the velocity."""

    def leg_in_air(self, now: GaitInput) -> LegInAir | None:
        """Return nothing: both feet are on the ground."""
        return None


class Standing(_OnBothFeet):
    """The robot stands; it steps for a velocity, or when it is pushed hard."""

    name = STAND

    def advance(self, now: GaitInput) -> Phase:
        """
        Stand, or start a step if a velocity is commanded or the robot is pushed hard.

        Parameters
        ----------
        now
            As for `Phase.advance`.

        Returns
        -------
        Phase
            This phase, or `Stepping`.

        """
        self._elapsed_s += now.passed_s
        self._context.approach_target(now.passed_s)
        self._context.path.restart()
        self._context.slope = self._context.footing.tilt
        if not self._context.target.is_zero:
            shift_s = self._context.parameters.timing.first_shift_s
            return Stepping(
                Step(self._context, self._first_support(), shift_s, now.zmp_m), self._context
            )
        off = self._off_balance(now.dcm_m)
        if self._elapsed_s > _SETTLED_S and self._is_pushed(off):
            support = RIGHT if off.imag > 0.0 else LEFT
            shift_s = self._context.parameters.timing.reactive_shift_s
            return Stepping(Step(self._context, support, shift_s, now.zmp_m), self._context)
        return self

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of DCM and ZMP: both are at the rest point between the feet.

        Parameters
        ----------
        now
            As for `Phase.reference`; it does not matter here.

        """
        rest_point = self._context.footing.rest_point
        return BalanceReference(rest_point, rest_point)

    def _first_support(self) -> int:
        """Return the foot that stays: not that on the side where the robot goes."""
        target = self._context.target
        return RIGHT if (target.left_m_s or target.turn_rad_s) > 0.0 else LEFT

    def _off_balance(self, dcm: Point) -> Point:
        """Return how far the divergent component is from rest, ahead and to the left."""
        feet = self._context.footing
        return PlanarPose(feet.rest_point, feet.middle.yaw_rad).local(dcm)

    def _is_pushed(self, off: Point) -> bool:
        """Tell whether the robot has to step to stay upright."""
        p = self._context.parameters
        return abs(off.real) > p.balance.push_forward_m or abs(off.imag) > p.balance.push_left_m


class Stepping:
    """
    Phase in which one foot swings, after the weight has gone to the other one.

    Parameters
    ----------
    step
        The step that is to be done.
    context
        What the phases of the gait share.

    """

    name = 'walk'

    def __init__(self, step: Step, context: GaitContext) -> None:
        self._context = context
        self._step = step

    @property
    def sides(self) -> tuple[int, ...]:
        """Return the sides whose feet carry the robot."""
        return self._step.sides

    @property
    def turning(self) -> Turning:
        """Return where the pelvis is to face."""
        return self._step.turning

    @property
    def footsteps(self) -> Sequence[Footstep]:
        """Return the steps that are planned."""
        return self._step.footsteps

    def replan(self, now: GaitInput) -> None:
        """
        Replan the landing of the swing foot.

        Parameters
        ----------
        now
            As for `Phase.replan`.

        """
        self._step.replan(now)

    def leg_in_air(self, now: GaitInput) -> LegInAir | None:
        """
        Get the leg that swings freely, and what pushes it.

        Parameters
        ----------
        now
            As for `Phase.leg_in_air`, which also says what is returned.

        """
        return self._step.leg_in_air(now)

    def advance(self, now: GaitInput) -> Phase:
        """
        Advance the step; when the foot has landed, start the next one, or stop.

        Parameters
        ----------
        now
            As for `Phase.advance`.

        Returns
        -------
        Phase
            This phase, `Stepping` with the next step, or `Stopping`.

        """
        step = self._step
        step.advance(now.passed_s)
        step.feel(now)
        if not step.has_landed(now):
            return self
        self._context.learn_slope(self._context.footing[step.support].plane.tilt)
        self._context.path.advance(step.support, self._context.command, step.duration_s)
        self._context.approach_target(self._context.parameters.timing.step_s)
        if self._context.is_stopping and self._may_rest():
            return Stopping(self._context, step.side, now.zmp_m)
        shift_s = self._context.parameters.timing.shift_s
        return Stepping(Step(self._context, step.side, shift_s, now.zmp_m), self._context)

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of DCM and ZMP from the plan of the step.

        Parameters
        ----------
        now
            As for `Phase.reference`.

        """
        return self._step.reference(now)

    def swing(self) -> Swing | None:
        """Compute the swing foot target, or None without one; call it once per control period."""
        return self._step.swing()

    def _may_rest(self) -> bool:
        """Tell whether the feet stand well and the robot is calm."""
        step, feet = self._step, self._context.footing
        stands_well = self._context.planner.is_parallel(
            feet.pose(step.support), step.support, feet.pose(step.side)
        )
        return stands_well and step.error_m < self._context.parameters.balance.stop_error_m


class Stopping(_OnBothFeet):
    """
    Phase in which both feet are down, and the weight goes to the middle between them.

    Parameters
    ----------
    context
        What the phases of the gait share.
    last_landed
        Side of the foot that landed last, which carries the robot first if it walks on.
    zmp
        Zero-moment point in use at the start (m), in the odom frame.

    """

    name = 'stop'

    def __init__(self, context: GaitContext, last_landed: int, zmp: Point) -> None:
        super().__init__(context)
        self._last_landed = last_landed
        way = ZmpSegment(context.parameters.timing.stop_s, zmp, context.footing.rest_point)
        self._plan = context.plan([way])

    def advance(self, now: GaitInput) -> Phase:
        """
        Come to rest, or walk on if a velocity is commanded soon enough.

        Parameters
        ----------
        now
            As for `Phase.advance`.

        Returns
        -------
        Phase
            This phase, `Standing` when the robot is at rest, or `Stepping`.

        """
        self._elapsed_s += now.passed_s
        p = self._context.parameters
        if self._elapsed_s > p.timing.stop_s + _REST_S:
            return Standing(self._context)
        if not self._context.target.is_zero and self._elapsed_s < _RESUMABLE * p.timing.stop_s:
            self._context.approach_target(p.timing.step_s)
            zmp = self._plan.at(self._elapsed_s).zmp_m
            return Stepping(
                Step(self._context, self._last_landed, p.timing.shift_s, zmp), self._context
            )
        return self

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of DCM and ZMP on the way to the rest point between the feet.

        Parameters
        ----------
        now
            As for `Phase.reference`; it does not matter here.

        """
        return self._plan.at(self._elapsed_s)
