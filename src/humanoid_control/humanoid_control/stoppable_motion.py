# SPDX-License-Identifier: Apache-2.0
"""A motion that can be held and released without a jump."""

from __future__ import annotations

from humanoid_control.joint_command import command_of, JointCommand
from humanoid_control.sine_motion import Motion

RESUME_S = 2.0
"""Time from a release until the joints are back in their motion."""


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

    def __init__(self, motion: Motion) -> None:
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

    def change(self, motion: Motion, now_s: float) -> None:
        """
        Switch to another motion; joints that are held stay where they are.

        Parameters
        ----------
        motion
            The motion to switch to, as in `Motion.followed_by`.
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
