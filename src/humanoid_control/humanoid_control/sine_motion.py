# SPDX-License-Identifier: Apache-2.0
"""Sinusoidal joint motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
import math


@dataclass(frozen=True)
class Swing:
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

    def followed_by(self, successor: Swing, now_s: float) -> Swing:
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
        Swing
            The successor, started at the angle that this swing has reached.

        """
        turned_rad = math.fmod(self._angle_rad(now_s) - self.phase_rad, math.tau)
        return replace(successor, turned_rad=turned_rad, since_s=now_s)

    def _angle_rad(self, now_s: float) -> float:
        """Compute the angle of the sine wave."""
        return self.frequency_rad_s * (now_s - self.since_s) + self.turned_rad + self.phase_rad


@dataclass(frozen=True)
class Motion:
    """The sinusoidal motion of several joints."""

    swings: tuple[Swing, ...]

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

    def followed_by(self, successor: Motion, now_s: float) -> Motion:
        """
        Switch to another motion; see `Swing.followed_by` for joints that are in both.

        Parameters
        ----------
        successor
            The motion to switch to.
        now_s
            Time of the change.

        Returns
        -------
        Motion
            The motion from then on, of the joints of the successor.

        """
        before = {swing.joint: swing for swing in self.swings}
        return Motion(
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
) -> Motion:
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
    return Motion(
        tuple(
            Swing(*columns)
            for columns in zip(joints, amplitudes_rad, frequencies_rad_s, phases_rad)
        )
    )
