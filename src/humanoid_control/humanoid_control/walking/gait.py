# SPDX-License-Identifier: Apache-2.0
"""Gait: its state machine, and its phases: standing, stepping and stopping."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gait_context import GaitContext, GaitInput, GaitOutput, Phase
from humanoid_control.walking.obstacle_guard import LegInAir
from humanoid_control.walking.pendulum import BalanceReference, ZmpSegment
from humanoid_control.walking.planar import LEFT, PlanarPose, Point, RIGHT, SIDES, Turning
from humanoid_control.walking.step import CurrentStep
from humanoid_control.walking.swing_foot import Swing

STAND = 'stand'
"""Name of the phase in which the robot stands still."""
_SETTLED_S = 0.3
"""Time after which a robot that stands steps to catch pushes."""
_REST_S = 0.1
"""Additional time at the end of stopping."""
_RESUMABLE = 0.5
"""Fraction of the stopping time in which the robot may walk on."""


class Gait:
    """
    State machine of the gait, with feedback that keeps the DCM at its reference.

    Parameters
    ----------
    context
        Context shared by the phases of the gait; the robot starts standing on its footholds.

    """

    def __init__(self, context: GaitContext) -> None:
        self._context = context
        self._phase: Phase = Standing(context)

    @property
    def phase(self) -> str:
        """Return the name of the phase."""
        return self._phase.name

    @property
    def footsteps(self) -> Sequence[Footstep]:
        """Return the planned footsteps."""
        return self._phase.footsteps

    @property
    def is_blocked(self) -> bool:
        """Whether an obstacle is in the way of the robot."""
        return self._context.guard.blockage is not None

    def update(self, now: GaitInput) -> GaitOutput:
        """
        Advance the gait by one control period.

        Parameters
        ----------
        now
            Estimates and measurements of this control period; points are in the odom frame.

        Returns
        -------
        GaitOutput
            References of balance, heading and swing foot in the odom frame, the zero-moment point
            with feedback of the DCM, and the sides of the feet that carry the robot.

        """
        if self._context.heed_obstacles(now, self._phase.leg_in_air(now)):
            self._phase.replan(now)
        self._phase = phase = self._phase.advance(now)
        reference, footing = phase.reference(now), self._context.footing
        # The DCM tracking law of Englsberger et al.: push the zero-moment point beyond the error.
        error = now.dcm_m - reference.dcm_m
        zmp = footing.polygon(phase.sides).clamped(
            reference.zmp_m + self._context.parameters.balance.dcm_gain * error
        )
        return GaitOutput(reference, zmp, phase.turning, phase.swing(), phase.sides)


class _OnBothFeet:
    """Base class of the phases with both feet on the ground: standing and stopping."""

    sides: tuple[int, ...] = SIDES
    footsteps: Sequence[Footstep] = ()

    def __init__(self, context: GaitContext) -> None:
        self._context = context
        self._elapsed_s = 0.0

    @property
    def turning(self) -> Turning:
        """Return the mean heading of the feet."""
        return Turning(self._context.footing.middle.yaw_rad)

    def swing(self) -> Swing | None:
        """Return None: no foot swings."""
        return None

    def replan(self, now: GaitInput) -> None:
        """Do nothing: the ZMP trajectory does not depend on the velocity."""

    def leg_in_air(self, now: GaitInput) -> LegInAir | None:
        """Return None: both feet are on the ground."""
        return None


class Standing(_OnBothFeet):
    """Phase in which the robot stands, until a velocity is commanded or it is pushed hard."""

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
                CurrentStep(self._context, self._first_support(), shift_s, now.zmp_m),
                self._context,
            )
        off = self._off_balance(now.dcm_m)
        if self._elapsed_s > _SETTLED_S and self._is_pushed(off):
            support = RIGHT if off.imag > 0.0 else LEFT
            shift_s = self._context.parameters.timing.reactive_shift_s
            return Stepping(CurrentStep(self._context, support, shift_s, now.zmp_m), self._context)
        return self

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of DCM and ZMP: both are at the rest point between the feet.

        Parameters
        ----------
        now
            As for `Phase.reference`; not used here.

        """
        rest_point = self._context.footing.rest_point
        return BalanceReference(rest_point, rest_point)

    def _first_support(self) -> int:
        """Select the support foot of the first step: opposite to the direction of motion."""
        target = self._context.target
        return RIGHT if (target.left_m_s or target.turn_rad_s) > 0.0 else LEFT

    def _off_balance(self, dcm: Point) -> Point:
        """Compute the offset of the DCM from the rest point, ahead and to the left."""
        feet = self._context.footing
        return PlanarPose(feet.rest_point, feet.middle.yaw_rad).local(dcm)

    def _is_pushed(self, off: Point) -> bool:
        """Check whether the robot has to step to stay upright."""
        p = self._context.parameters
        return abs(off.real) > p.balance.push_forward_m or abs(off.imag) > p.balance.push_left_m


class Stepping:
    """
    Phase in which one foot swings, after the weight has shifted to the other one.

    Parameters
    ----------
    step
        The step to execute.
    context
        Context shared by the phases of the gait.

    """

    name = 'walk'

    def __init__(self, step: CurrentStep, context: GaitContext) -> None:
        self._context = context
        self._step = step

    @property
    def sides(self) -> tuple[int, ...]:
        """Return the sides of the feet that carry the robot."""
        return self._step.sides

    @property
    def turning(self) -> Turning:
        """Return the target heading of the pelvis."""
        return self._step.turning

    @property
    def footsteps(self) -> Sequence[Footstep]:
        """Return the planned footsteps."""
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
        Get the leg that swings freely, and the push on it.

        Parameters
        ----------
        now
            As for `Phase.leg_in_air`, which also describes the result.

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
        if not step.advance(now):
            return self
        self._context.learn_slope(self._context.footing[step.support].plane.tilt)
        self._context.path.advance(step.support, self._context.velocity, step.duration_s)
        self._context.approach_target(self._context.parameters.timing.step_s)
        if self._context.is_stopping and self._may_rest():
            return Stopping(self._context, step.side, now.zmp_m)
        shift_s = self._context.parameters.timing.shift_s
        return Stepping(CurrentStep(self._context, step.side, shift_s, now.zmp_m), self._context)

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
        """Check whether the feet are side by side and the error of the DCM is small."""
        step, feet = self._step, self._context.footing
        stands_well = self._context.planner.is_parallel(
            feet.pose(step.support), step.support, feet.pose(step.side)
        )
        return stands_well and step.error_m < self._context.parameters.balance.stop_error_m


class Stopping(_OnBothFeet):
    """
    Phase in which both feet are down, and the weight shifts to the middle between them.

    Parameters
    ----------
    context
        Context shared by the phases of the gait.
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
        Continue to stop, or walk on if a velocity is commanded soon enough.

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
                CurrentStep(self._context, self._last_landed, p.timing.shift_s, zmp), self._context
            )
        return self

    def reference(self, now: GaitInput) -> BalanceReference:
        """
        Compute the reference of DCM and ZMP on the way to the rest point between the feet.

        Parameters
        ----------
        now
            As for `Phase.reference`; not used here.

        """
        return self._plan.at(self._elapsed_s)
