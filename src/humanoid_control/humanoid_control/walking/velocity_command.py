# SPDX-License-Identifier: Apache-2.0
"""How fast the robot is to go, and how fast it can."""

from __future__ import annotations

from dataclasses import astuple, dataclass
import math

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.planar import limited, Point


@dataclass(frozen=True)
class VelocityCommand:
    """A velocity of the body in its own axes: forward, to the left, anticlockwise."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no number."""
        if not all(map(math.isfinite, astuple(self))):
            raise WalkingError(
                f'The velocity (forward {self.forward_m_s:g} m/s, left {self.left_m_s:g} m/s, '
                f'turn {self.turn_rad_s:g} rad/s) is not finite. It is refused; the last '
                'velocity goes on.'
            )

    @property
    def linear_m_s(self) -> Point:
        """Return the velocity without the turn."""
        return complex(self.forward_m_s, self.left_m_s)

    @property
    def is_zero(self) -> bool:
        """Tell whether the robot is to stand."""
        return not (self.forward_m_s or self.left_m_s or self.turn_rad_s)

    def times(self, factor: float) -> VelocityCommand:
        """
        Scale all components of the velocity.

        Parameters
        ----------
        factor
            What they are multiplied by.

        """
        return VelocityCommand(
            self.forward_m_s * factor, self.left_m_s * factor, self.turn_rad_s * factor
        )

    def towards(self, target: VelocityCommand, most: VelocityCommand) -> VelocityCommand:
        """
        Approach a target velocity by a limited change of each component.

        Parameters
        ----------
        target
            The velocity to go to; it is reached exactly.
        most
            The largest change of each component, not negative.

        """
        return VelocityCommand(
            _nearer(self.forward_m_s, target.forward_m_s, most.forward_m_s),
            _nearer(self.left_m_s, target.left_m_s, most.left_m_s),
            _nearer(self.turn_rad_s, target.turn_rad_s, most.turn_rad_s),
        )


STANDING = VelocityCommand()


@dataclass(frozen=True)
class VelocityLimits:
    """The speeds that the gait can do: each one alone, and together in the sum of their shares."""

    forward_m_s: float
    backward_m_s: float
    left_m_s: float
    turn_rad_s: float
    sum_of_shares: float

    def applied(self, command: VelocityCommand) -> VelocityCommand:
        """
        Limit a velocity to what the gait can do.

        Each component is clamped; if the shares then sum up to too much, all are scaled alike.

        Parameters
        ----------
        command
            The velocity that is asked for.

        """
        single = VelocityCommand(
            limited(command.forward_m_s, -self.backward_m_s, self.forward_m_s),
            limited(command.left_m_s, -self.left_m_s, self.left_m_s),
            limited(command.turn_rad_s, -self.turn_rad_s, self.turn_rad_s),
        )
        asked = self.shares(single)
        return single if asked <= self.sum_of_shares else single.times(self.sum_of_shares / asked)

    def shares(self, command: VelocityCommand) -> float:
        """
        Compute the sum of the shares that a velocity takes of the limits.

        Parameters
        ----------
        command
            The velocity, in the axes of the robot.

        Returns
        -------
        float
            1 for a single component at its limit.

        """
        ahead = self.forward_m_s if command.forward_m_s >= 0 else self.backward_m_s
        return (
            abs(command.forward_m_s) / ahead
            + abs(command.left_m_s) / self.left_m_s
            + abs(command.turn_rad_s) / self.turn_rad_s
        )


def _nearer(value: float, target: float, most: float) -> float:
    """Return the value moved to the target by at most so much; it arrives exactly."""
    step = target - value
    return target if abs(step) <= most else value + math.copysign(most, step)
