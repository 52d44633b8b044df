# SPDX-License-Identifier: Apache-2.0
"""Joint commands: target positions and velocities."""

from __future__ import annotations

from dataclasses import dataclass, replace

from humanoid_control.sine_motion import Motion


@dataclass(frozen=True)
class JointCommand:
    """A position and a velocity for each joint."""

    joints: list[str]
    positions_rad: list[float]
    velocities_rad_s: list[float]

    def still(self) -> JointCommand:
        """Return a command that holds the same positions, at zero velocity."""
        return replace(self, velocities_rad_s=[0.0] * len(self.joints))


def command_of(motion: Motion, now_s: float) -> JointCommand:
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
