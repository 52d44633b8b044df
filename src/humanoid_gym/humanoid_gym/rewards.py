# SPDX-License-Identifier: Apache-2.0
"""
Reward terms that several tasks share, each with its weight, per second of simulated time.

Sources: the forms of tracking, vertical velocity, roll and pitch rate, torque, acceleration and
action rate are those of Rudin, Hoeller, Reist and Hutter, "Learning to Walk in Minutes Using
Massively Parallel Deep Reinforcement Learning" (CoRL 2021). Unless a comment says otherwise, the
weights are the defaults of their program, legged_gym (`LeggedRobotCfg`). The constant reward for
not having fallen is the healthy reward of the environment Humanoid of Gymnasium.
"""

from __future__ import annotations

from dataclasses import dataclass
import math

from humanoid_control.backends import Array, Observation
from humanoid_control.walking import VelocityCommand
from humanoid_simulation.backend import EntityState

VELOCITY_WIDTH_M_S = 0.25
"""Half of theirs: this robot walks at up to 0.5 m/s."""
TURN_WIDTH_RAD_S = 0.5
ALIVE = 0.5
"""Chosen so that a robot that walks badly earns more than one that falls."""
FALL = -5.0
"""Once, for a fall, besides the rewards of the rest of the episode that it loses; our choice."""


@dataclass(frozen=True, eq=False)
class Motion:
    """The true state of the robot after a step, and what has changed in the step."""

    base: EntityState
    yaw_rad: float
    tilt_rad: float
    sensed: Observation
    """Without noise."""
    accelerations_rad_s2: Array
    """(n,) mean accelerations of the joints in the step"""
    action_change: Array
    """Difference of the action from the last one."""
    has_fallen: bool

    @property
    def velocity_m_s(self) -> complex:
        """Return the velocity of the base: forward (real), to the left (imaginary)."""
        x, y, _ = self.base.linear_velocity_m_s.tolist()
        turn = complex(math.cos(self.yaw_rad), -math.sin(self.yaw_rad))
        return complex(x, y) * turn


def kernel(error: float, width: float) -> float:
    """
    Map an error to a reward: 1 without error, 1/e at an error of the width.

    Parameters
    ----------
    error, width
        Both in the same unit.

    """
    return math.exp(-((error / width) ** 2))


def tracking(motion: Motion, command: VelocityCommand) -> dict[str, float]:
    """
    Reward a velocity that is the commanded one.

    Parameters
    ----------
    motion
        The motion of the robot.
    command
        The commanded velocity; zero to stand.

    """
    off_m_s = abs(motion.velocity_m_s - command.linear_m_s)
    off_rad_s = float(motion.base.angular_velocity_rad_s[2]) - command.turn_rad_s
    return {
        'velocity': 1.0 * kernel(off_m_s, VELOCITY_WIDTH_M_S),
        'turn': 0.5 * kernel(off_rad_s, TURN_WIDTH_RAD_S),
    }


def steadiness(motion: Motion) -> dict[str, float]:
    """
    Penalise a base that moves up and down, or rolls and pitches.

    Parameters
    ----------
    motion
        The motion of the robot.

    """
    rates = motion.base.angular_velocity_rad_s[:2]
    return {
        'vertical_velocity': -2.0 * float(motion.base.linear_velocity_m_s[2]) ** 2,
        'roll_pitch_rate': -0.05 * float(rates @ rates),
    }


def effort(motion: Motion) -> dict[str, float]:
    """
    Penalise torques, accelerations of the joints, and changes of the action.

    Parameters
    ----------
    motion
        The motion of the robot.

    """
    torques, accelerations = motion.sensed.efforts_nm, motion.accelerations_rad_s2
    return {
        'torque': -1e-5 * float(torques @ torques),
        'acceleration': -2.5e-7 * float(accelerations @ accelerations),
        'action_rate': -0.01 * float(motion.action_change @ motion.action_change),
    }
