# SPDX-License-Identifier: Apache-2.0
"""Velocity commands, and the velocity limits of the gait."""

from __future__ import annotations

from dataclasses import astuple, dataclass
import math

from humanoid_control.errors import WalkingError
from humanoid_control.walking.parameters import VelocityParameters
from humanoid_control.walking.planar import limited, Point


@dataclass(frozen=True)
class VelocityCommand:
    """Velocity command in the axes of the robot: forward, to the left, anticlockwise."""

    forward_m_s: float = 0.0
    left_m_s: float = 0.0
    turn_rad_s: float = 0.0

    def __post_init__(self) -> None:
        """Reject non-finite components."""
        if not all(map(math.isfinite, astuple(self))):
            raise WalkingError(
                f'The velocity (forward {self.forward_m_s:g} m/s, left {self.left_m_s:g} m/s, '
                f'turn {self.turn_rad_s:g} rad/s) is not finite. It is rejected; the last '
                'velocity continues.'
            )

    @property
    def linear_m_s(self) -> Point:
        """Return the linear velocity: forward (real), to the left (imaginary)."""
        return complex(self.forward_m_s, self.left_m_s)

    @property
    def is_zero(self) -> bool:
        """Whether all components are zero, so that the robot stands."""
        return not (self.forward_m_s or self.left_m_s or self.turn_rad_s)

    def times(self, factor: float) -> VelocityCommand:
        """
        Scale all components of the velocity.

        Parameters
        ----------
        factor
            Scale factor of all components.

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
            Target velocity; it is reached exactly.
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
    """Velocity limits of the gait: for each component, and for the sum of shares of these."""

    forward_m_s: float
    backward_m_s: float
    left_m_s: float
    turn_rad_s: float
    sum_of_shares: float

    @classmethod
    def of(cls, parameters: VelocityParameters) -> VelocityLimits:
        """
        Read the limits from the parameters of the gait.

        Parameters
        ----------
        parameters : VelocityParameters
            Limits of the velocity, scaled to the size of the robot.

        """
        return cls(
            parameters.forward_limit_m_s,
            parameters.backward_limit_m_s,
            parameters.left_limit_m_s,
            parameters.turn_limit_rad_s,
            parameters.sum_of_shares,
        )

    def applied(self, command: VelocityCommand) -> VelocityCommand:
        """
        Clamp a velocity to the limits of the gait.

        Each component is clamped; if the sum of the shares then exceeds its limit, all components
        are scaled down by the same factor.

        Parameters
        ----------
        command
            Commanded velocity, in the axes of the robot.

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
        Compute the sum of the components of a velocity, each as a share of its limit.

        Parameters
        ----------
        command
            Velocity, in the axes of the robot.

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


def largest_change(parameters: VelocityParameters, time_s: float) -> VelocityCommand:
    """
    Compute the largest change of the velocity in a given time.

    Parameters
    ----------
    parameters : VelocityParameters
        Limits of the acceleration, scaled to the size of the robot.
    time_s
        Time for which the robot accelerates at its limits.

    Returns
    -------
    VelocityCommand
        The largest change of each component.

    """
    return VelocityCommand(
        parameters.forward_acceleration_m_s2 * time_s,
        parameters.left_acceleration_m_s2 * time_s,
        parameters.turn_acceleration_rad_s2 * time_s,
    )


def _nearer(value: float, target: float, most: float) -> float:
    """Move a value towards a target by at most `most`; the target is reached exactly."""
    step = target - value
    return target if abs(step) <= most else value + math.copysign(most, step)
