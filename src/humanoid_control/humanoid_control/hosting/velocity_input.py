# SPDX-License-Identifier: Apache-2.0
"""The velocity that somebody wants the robot to walk at, for as long as they say so."""

from __future__ import annotations

from dataclasses import astuple, dataclass
import math

from humanoid_control.controllers.commands import CommandError
from humanoid_control.controllers.silence import Clock, Silence

TIMEOUT_S = 0.5


@dataclass(frozen=True)
class Velocity:
    """How fast to walk forwards and to the left, and to turn to the left."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0


STANDING = Velocity()


class VelocityInput:
    """The newest velocity; none after the timeout."""

    def __init__(self, timeout_s: float = TIMEOUT_S, clock: Clock | None = None) -> None:
        """Begin without a wish."""
        self._silence = Silence(timeout_s, clock)
        self._newest = STANDING

    def accept(self, velocity: Velocity) -> None:
        """Take a velocity, or refuse one that is no number."""
        if not all(map(math.isfinite, astuple(velocity))):
            raise CommandError(f'The velocity is {astuple(velocity)}. Give finite numbers.')
        self._newest = velocity
        self._silence.heard()

    def clear(self) -> None:
        """Forget what was wished."""
        self._silence.end()

    def at(self, now_s: float) -> Velocity:
        """Return the velocity at a moment of the robot's time."""
        return STANDING if self._silence.lasts(now_s) else self._newest
