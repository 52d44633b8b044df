# SPDX-License-Identifier: Apache-2.0
"""The border between controllers and what they control."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Observation:
    """
    What the sensors of a robot with n joints say at a moment, in the order of its joints.

    The orientation is that of `imu_link` in the world, a unit quaternion w, x, y, z; rates and
    acceleration (specific force: +g upwards at rest) are in `imu_link`. Feet are left, right:
    force and torque of the ground on the foot, about the sole and in its axes.
    """

    time_s: float
    positions_rad: Array
    """(n,)"""
    velocities_rad_s: Array
    """(n,)"""
    efforts_nm: Array
    """(n,) what the drives exert"""
    orientation: Array
    """(4,)"""
    angular_velocity_rad_s: Array
    """(3,)"""
    linear_acceleration_m_s2: Array
    """(3,)"""
    foot_forces_n: Array
    """(2, 3)"""
    foot_torques_nm: Array
    """(2, 3)"""


@dataclass(frozen=True, eq=False)
class JointTargets:
    """
    What the drives of n joints are to do; each array is (n,).

    A drive exerts kp (position - q) + kd (velocity - dq) + effort, within its limits, with the
    gains of the model. Until new targets come, it goes on towards them.
    """

    positions_rad: Array
    velocities_rad_s: Array
    efforts_nm: Array


class Backend(Protocol):
    """
    Robots of which each has a name: its namespace, '' if it is alone.

    Time passes in `step` only: by one period, in which the targets hold.
    """

    @property
    def robots(self) -> tuple[str, ...]:
        """Return the names of the robots."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the names of the driven joints; all robots have the same."""

    @property
    def period_s(self) -> float:
        """Return the time of a step."""

    def observe(self) -> Mapping[str, Observation]:
        """Return what the sensors of every robot say now."""

    def step(self, targets: Mapping[str, JointTargets]) -> None:
        """Let time pass; a robot without targets keeps those that it had."""

    def reset(self, keyframe: str = 'home') -> None:
        """Put all robots where they began, at rest, in a posture that has a name; time goes on."""

    def close(self) -> None:
        """Give back what is held; nothing else may be called after it."""
