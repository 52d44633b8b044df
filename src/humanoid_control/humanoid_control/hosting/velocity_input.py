# SPDX-License-Identifier: Apache-2.0
"""The velocity that somebody wants the robot to walk at, for as long as they say so."""

from __future__ import annotations

from humanoid_control.controllers.silence import Clock, Silence
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand

TIMEOUT_S = 0.5


class VelocityInput:
    """
    The newest velocity command, which expires unless it is repeated.

    Parameters
    ----------
    timeout_s
        How long a command is in force.
    clock
        Tells the computer's time in s, by which the timeout must have passed, too; without it the
        robot's time alone counts.

    """

    def __init__(self, timeout_s: float = TIMEOUT_S, clock: Clock | None = None) -> None:
        self._silence = Silence(timeout_s, clock)
        self._newest = STANDING

    def accept(self, velocity: VelocityCommand) -> None:
        """
        Take a velocity command, and restart the timeout.

        Parameters
        ----------
        velocity
            The velocity in the axes of the body.

        """
        self._newest = velocity
        self._silence.heard()

    def clear(self) -> None:
        """Forget what was wished."""
        self._silence.end()

    def at(self, now_s: float) -> VelocityCommand:
        """
        Look up the velocity command in force; zero once the last one has expired.

        Parameters
        ----------
        now_s
            The robot's time. A command expires when the timeout has passed by it and by the
            computer's clock, if one was given.

        """
        return STANDING if self._silence.lasts(now_s) else self._newest
