# SPDX-License-Identifier: Apache-2.0
"""Commands to a walk: its velocity, and the body pose while it stands, with their limits."""

from __future__ import annotations

from dataclasses import astuple, dataclass
import math

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.gait_parameters import BodyPoseParameters, VelocityParameters
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


@dataclass(frozen=True)
class BodyPose:
    """
    Body pose: pitch of the pelvis and height of the centre of mass.

    Attributes
    ----------
    pitch_rad
        Pitch of the pelvis, positive when it is bent forward.
    height_m
        Height of the centre of mass relative to an upright robot; negative is lower.

    """

    pitch_rad: float = 0.0
    height_m: float = 0.0

    def within(self, parameters: BodyPoseParameters) -> BodyPose:
        """
        Clamp the pose to the range that the robot can reach.

        Parameters
        ----------
        parameters : BodyPoseParameters
            Limits of the pitch (`bend_rad`, `bend_back_rad`) and of the height (`lower_m`).

        Raises
        ------
        WalkingError
            The pose is not finite.

        """
        if not (math.isfinite(self.pitch_rad) and math.isfinite(self.height_m)):
            raise WalkingError(
                f'The body cannot be pitched by {self.pitch_rad:g} rad at a height of '
                f'{self.height_m:g} m: give finite numbers.'
            )
        return BodyPose(
            min(max(self.pitch_rad, -parameters.bend_back_rad), parameters.bend_rad),
            min(max(self.height_m, -parameters.lower_m), 0.0),
        )


UPRIGHT = BodyPose()


@dataclass
class BodyPoseFollower:
    """Rate limiter for the body pose, so that the balance can follow."""

    parameters: BodyPoseParameters
    pose: BodyPose = UPRIGHT
    """Present target of the body pose."""
    pitch_rate_rad_s: float = 0.0

    @property
    def is_upright(self) -> bool:
        """Whether the body is upright enough to step."""
        p = self.parameters
        return (
            abs(self.pose.pitch_rad) < p.upright_pitch_rad
            and self.pose.height_m > -p.upright_height_m
        )

    def update(self, wanted: BodyPose, passed_s: float) -> None:
        """
        Move the body pose towards a wanted one at limited rates. Call once per control period.

        Parameters
        ----------
        wanted
            Pose to reach, within the limits (see `BodyPose.within`).
        passed_s
            Time since the last call.

        """
        p = self.parameters
        pitch_rad = _towards(self.pose.pitch_rad, wanted.pitch_rad, p.bend_rad_s * passed_s)
        height_m = _towards(self.pose.height_m, wanted.height_m, p.lower_m_s * passed_s)
        turned_rad = pitch_rad - self.pose.pitch_rad
        self.pitch_rate_rad_s = turned_rad / passed_s if passed_s > 0.0 else 0.0
        self.pose = BodyPose(pitch_rad, height_m)


def _towards(start: float, end: float, most: float) -> float:
    """Move a value towards another by at most `most`."""
    return start + min(max(end - start, -most), most)
