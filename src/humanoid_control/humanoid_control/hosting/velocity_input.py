# SPDX-License-Identifier: Apache-2.0
"""Velocity command of the walk, with a timeout."""

from __future__ import annotations

from humanoid_control.controllers.silence import Clock, Silence
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand

TIMEOUT_S = 0.5


class VelocityInput:
    """
    The latest velocity command, which expires unless it is repeated.

    Parameters
    ----------
    timeout_s
        How long a command is in force.
    clock
        Returns the computer's time in s, by which the timeout must have passed as well; without it
        only the robot's time counts.

    """

    def __init__(self, timeout_s: float = TIMEOUT_S, clock: Clock | None = None) -> None:
        self._silence = Silence(timeout_s, clock)
        self._newest = STANDING

    def accept(self, velocity: VelocityCommand) -> None:
        """
        Accept a velocity command, and restart the timeout.

        Parameters
        ----------
        velocity
            The velocity in the axes of the body.

        """
        self._newest = velocity
        self._silence.heard()

    def clear(self) -> None:
        """Clear the velocity command."""
        self._silence.end()

    def at(self, now_s: float) -> VelocityCommand:
        """
        Return the velocity command in force; zero once the last one has expired.

        Parameters
        ----------
        now_s
            The robot's time. A command expires when the timeout has passed by it and by the
            computer's clock, if one was given.

        """
        return STANDING if self._silence.lasts(now_s) else self._newest
