# SPDX-License-Identifier: Apache-2.0
"""Sine motion of joints, which can be held and released without a jump."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
import math

RESUME_S = 2.0
"""Time from a release until the joints are back in their motion."""


@dataclass(frozen=True)
class Sinusoid:
    """
    Sinusoidal motion of one joint: amplitude times the sine of a growing angle.

    `turned_rad` is the angle at the time `since_s`, to which the phase is added.
    """

    joint: str
    amplitude_rad: float
    frequency_rad_s: float
    phase_rad: float = 0.0
    turned_rad: float = 0.0
    since_s: float = 0.0

    def position_rad(self, now_s: float) -> float:
        """
        Compute the position of the joint in rad.

        Parameters
        ----------
        now_s
            Time in the motion.

        """
        return self.amplitude_rad * math.sin(self._angle_rad(now_s))

    def velocity_rad_s(self, now_s: float) -> float:
        """
        Compute the velocity of the joint in rad/s, the derivative of its position.

        Parameters
        ----------
        now_s
            Time in the motion.

        """
        return self.amplitude_rad * self.frequency_rad_s * math.cos(self._angle_rad(now_s))

    def followed_by(self, successor: Sinusoid, now_s: float) -> Sinusoid:
        """
        Switch to another swing with a continuous angle.

        Amplitude and phase change at once: the position jumps if they differ.

        Parameters
        ----------
        successor
            The swing to switch to.
        now_s
            Time of the change.

        Returns
        -------
        Sinusoid
            The successor, started at the angle that this swing has reached.

        """
        turned_rad = math.fmod(self._angle_rad(now_s) - self.phase_rad, math.tau)
        return replace(successor, turned_rad=turned_rad, since_s=now_s)

    def _angle_rad(self, now_s: float) -> float:
        """Compute the angle of the sine wave."""
        return self.frequency_rad_s * (now_s - self.since_s) + self.turned_rad + self.phase_rad


@dataclass(frozen=True)
class SineMotion:
    """The sinusoidal motion of several joints."""

    swings: tuple[Sinusoid, ...]

    @property
    def joints(self) -> list[str]:
        """Return the names of the joints, in order."""
        return [swing.joint for swing in self.swings]

    def positions_rad(self, now_s: float) -> list[float]:
        """
        Compute the positions of the joints in rad, in their order.

        Parameters
        ----------
        now_s
            Time in the motion.

        """
        return [swing.position_rad(now_s) for swing in self.swings]

    def velocities_rad_s(self, now_s: float) -> list[float]:
        """
        Compute the velocities of the joints in rad/s, in their order.

        Parameters
        ----------
        now_s
            Time in the motion.

        """
        return [swing.velocity_rad_s(now_s) for swing in self.swings]

    def followed_by(self, successor: SineMotion, now_s: float) -> SineMotion:
        """
        Switch to another motion; see `Sinusoid.followed_by` for joints that are in both.

        Parameters
        ----------
        successor
            The motion to switch to.
        now_s
            Time of the change.

        Returns
        -------
        SineMotion
            The motion from then on, of the joints of the successor.

        """
        before = {swing.joint: swing for swing in self.swings}
        return SineMotion(
            tuple(
                before[swing.joint].followed_by(swing, now_s) if swing.joint in before else swing
                for swing in successor.swings
            )
        )


def motion_of(
    joints: Sequence[str],
    amplitudes_rad: Sequence[float],
    frequencies_rad_s: Sequence[float],
    phases_rad: Sequence[float],
) -> SineMotion:
    """
    Build a motion from lists with one element per joint.

    Parameters
    ----------
    joints
        Names of the joints.
    amplitudes_rad
        Amplitudes of the swing of each joint about zero.
    frequencies_rad_s
        Angular frequencies.
    phases_rad
        Phases at time zero.

    """
    return SineMotion(
        tuple(
            Sinusoid(*columns)
            for columns in zip(joints, amplitudes_rad, frequencies_rad_s, phases_rad)
        )
    )


@dataclass(frozen=True)
class JointCommand:
    """A position and a velocity for each joint."""

    joints: list[str]
    positions_rad: list[float]
    velocities_rad_s: list[float]

    def still(self) -> JointCommand:
        """Return a command that holds the same positions, at zero velocity."""
        return replace(self, velocities_rad_s=[0.0] * len(self.joints))


def command_of(motion: SineMotion, now_s: float) -> JointCommand:
    """
    Sample the positions and velocities of a motion at a time.

    Parameters
    ----------
    motion
        The motion of the joints.
    now_s
        Time in the motion.

    """
    return JointCommand(motion.joints, motion.positions_rad(now_s), motion.velocities_rad_s(now_s))


class StoppableMotion:
    """
    A motion whose time stands still while it is held.

    After a release the joints blend smoothly from rest where they were held into the motion, even
    if the motion has changed meanwhile.

    Parameters
    ----------
    motion
        The motion of the joints, which is not held at first.

    """

    def __init__(self, motion: SineMotion) -> None:
        self._motion = motion
        self._behind_s = 0.0
        self._last: JointCommand | None = None
        self._held_since_s: float | None = None
        self._released_s: float | None = None
        self._held: dict[str, float] = {}

    def command(self, now_s: float, hold: bool) -> JointCommand | None:
        """
        Compute the current joint command, held or moving.

        Parameters
        ----------
        now_s
            Time of the clock that the motion follows.
        hold
            Whether the joints must hold still; when that ends, they blend into the motion again.

        Returns
        -------
        JointCommand or None
            None while holding before the first command.

        """
        if hold:
            self._begin_to_hold(now_s)
        else:
            self._begin_to_move(now_s)
            self._last = self._blended(command_of(self._motion, now_s - self._behind_s), now_s)
        return self._last

    def change(self, motion: SineMotion, now_s: float) -> None:
        """
        Switch to another motion; joints that are held stay where they are.

        Parameters
        ----------
        motion
            The motion to switch to, as in `SineMotion.followed_by`.
        now_s
            Time of the clock that the motion follows.

        """
        moment_s = now_s if self._held_since_s is None else self._held_since_s
        self._motion = self._motion.followed_by(motion, moment_s - self._behind_s)

    def _begin_to_hold(self, now_s: float) -> None:
        if self._held_since_s is None:
            self._held_since_s = now_s
            self._last = self._last.still() if self._last else None

    def _begin_to_move(self, now_s: float) -> None:
        if self._held_since_s is not None:
            self._behind_s += now_s - self._held_since_s
            self._held_since_s = None
            self._released_s = now_s
            last = self._last
            self._held = dict(zip(last.joints, last.positions_rad)) if last else {}

    def _blended(self, target: JointCommand, now_s: float) -> JointCommand:
        """Blend from where the joints were held into the motion."""
        if self._released_s is None:
            return target
        passed = (now_s - self._released_s) / RESUME_S
        if passed >= 1.0:
            self._released_s = None
            return target
        share, growth_per_s = passed**2 * (3 - 2 * passed), 6 * passed * (1 - passed) / RESUME_S
        positions_rad, velocities_rad_s = [], []
        for joint, to_rad, speed_rad_s in zip(
            target.joints, target.positions_rad, target.velocities_rad_s
        ):
            from_rad = self._held.get(joint, to_rad)
            positions_rad.append(from_rad + share * (to_rad - from_rad))
            velocities_rad_s.append(growth_per_s * (to_rad - from_rad) + share * speed_rad_s)
        return JointCommand(target.joints, positions_rad, velocities_rad_s)
