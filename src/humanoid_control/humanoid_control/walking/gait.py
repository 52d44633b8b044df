# SPDX-License-Identifier: Apache-2.0
"""Gait: from a velocity and the state of the robot to references of balance and swing foot."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.walking.footsteps import Footstep
from humanoid_control.walking.gait_context import GaitContext, GaitInput, GaitOutput
from humanoid_control.walking.phases import Phase, Standing


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
        return GaitOutput(
            reference,
            zmp,
            phase.turning,
            phase.swing(),
            phase.sides,
        )
