# SPDX-License-Identifier: Apache-2.0
"""The border between controllers and what they control."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from humanoid_common.errors import NodeStartError
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class BackendError(NodeStartError):
    """Tell why a robot can no longer be moved; its node ends with this sentence."""


@dataclass(frozen=True, eq=False)
class Observation:
    """
    What the sensors of a robot with n joints say at a moment, in the order of its joints.

    Of joints that slide, positions are in m, velocities in m/s and efforts in N.

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


@dataclass(frozen=True)
class ImuNoise:
    """
    How far an inertial measurement unit without a compass is off: standard deviations.

    Biases are part of the errors: whoever uses a measurement does not know them. All zero is a
    sensor whose errors are not known.
    """

    tilt_rad: float = 0.0
    """Of roll and pitch, which gravity bounds."""
    angular_velocity_rad_s: float = 0.0
    """About each axis."""
    acceleration_m_s2: float = 0.0
    """Along each axis."""
    heading_drift_rad_s: float = 0.0
    """Of the constant rate at which the heading drifts."""
    heading_walk_rad_sqrt_s: float = 0.0
    """Of the heading after a second, besides the drift; it grows with the root of the time."""
    tilt_bias_rad: float = 0.0
    """Of that part of roll and pitch which stays: the sensor takes level ground for a slope."""

    def heading_variance_rad2(self, passed_s: float) -> float:
        """
        Compute the variance of the heading after some time without a correction, in rad2.

        Parameters
        ----------
        passed_s
            The time since the heading was known.

        """
        drift_rad = self.heading_drift_rad_s * passed_s
        return drift_rad * drift_rad + self.heading_walk_rad_sqrt_s**2 * passed_s


@dataclass(frozen=True, eq=False)
class JointTargets:
    """
    What the drives of n joints are to do; each array is (n,), in the units of `Observation`.

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
        """Return what the sensors of every robot say now, or raise BackendError."""

    def step(self, targets: Mapping[str, JointTargets]) -> None:
        """
        Advance all robots by one period.

        Parameters
        ----------
        targets
            Joint targets by the names of the robots; a robot without an entry keeps those that it
            had.

        """

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset all robots to where they began, at rest; time goes on.

        Parameters
        ----------
        keyframe
            The name of the posture that they take. An unknown one raises the backend's own error.

        """

    def close(self) -> None:
        """Give back what is held; nothing else may be called after it."""
