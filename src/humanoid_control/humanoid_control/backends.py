# SPDX-License-Identifier: Apache-2.0
"""What controllers and the robots that they control exchange: observations and limited targets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from humanoid_common.errors import UserError
from humanoid_description.drives import Drive
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class BackendError(UserError):
    """A robot can no longer be moved; its node ends with this message."""


@dataclass(frozen=True, eq=False)
class Observation:
    """
    Sensor values of a robot with n joints at a moment, in the order of its joints.

    Prismatic joints have positions in m, velocities in m/s and efforts in N.

    The orientation is that of `imu_link` in the world, as a unit quaternion w, x, y, z; angular
    velocity and acceleration (specific force: +g upwards at rest) are in `imu_link`. Feet are in
    the order left, right: force and torque of the ground on the foot, about the sole and in its
    axes.
    """

    time_s: float
    positions_rad: Array
    """(n,)"""
    velocities_rad_s: Array
    """(n,)"""
    efforts_nm: Array
    """(n,) actuator torques"""
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
    Noise of an IMU without a magnetometer, as standard deviations.

    Biases count as errors, as the users of a measurement do not know them. All zero means that the
    errors are unknown.
    """

    tilt_rad: float = 0.0
    """Roll and pitch, whose error gravity bounds."""
    angular_velocity_rad_s: float = 0.0
    """Angular velocity about each axis."""
    acceleration_m_s2: float = 0.0
    """Acceleration along each axis."""
    heading_drift_rad_s: float = 0.0
    """Constant drift rate of the heading."""
    heading_walk_rad_sqrt_s: float = 0.0
    """Random walk of the heading after 1 s, besides the drift; grows with the root of the time."""
    tilt_bias_rad: float = 0.0
    """Constant bias of roll and pitch, which makes level ground look like a slope."""

    def heading_variance_rad2(self, passed_s: float) -> float:
        """
        Compute the variance of the heading after some time without a correction, in rad2.

        Parameters
        ----------
        passed_s
            Time since the heading was last known.

        """
        drift_rad = self.heading_drift_rad_s * passed_s
        return drift_rad * drift_rad + self.heading_walk_rad_sqrt_s**2 * passed_s


@dataclass(frozen=True, eq=False)
class JointTargets:
    """
    Targets of the actuators of n joints; each array is (n,), in the units of `Observation`.

    An actuator exerts kp (position - q) + kd (velocity - dq) + effort, within its limits, with the
    gains of the model. Targets stay in force until new ones come.
    """

    positions_rad: Array
    velocities_rad_s: Array
    efforts_nm: Array


@dataclass(frozen=True, eq=False)
class JointLimits:
    """Position, velocity and effort limits of n joints (n,); in m, m/s and N if prismatic."""

    lower_rad: Array
    upper_rad: Array
    velocity_rad_s: Array
    effort_nm: Array
    kp_nm_rad: Array
    """Stiffness of the servos: effort per position error."""

    @classmethod
    def of(cls, drives: Mapping[str, Drive], joints: Sequence[str]) -> JointLimits:
        """
        Collect the limits of joints from their actuators.

        Parameters
        ----------
        drives
            The actuator of each joint, by name.
        joints
            Names of the n joints, in the order of the limits.

        """
        columns = [
            (drive.lower, drive.upper, drive.velocity, drive.effort, drive.kp)
            for drive in (drives[joint] for joint in joints)
        ]
        return cls(*np.array(columns, dtype=np.float64).reshape(-1, 5).T.copy())

    def limited(self, targets: JointTargets, last_rad: Array, elapsed_s: float) -> JointTargets:
        """
        Clamp joint targets to the position, velocity and effort limits.

        A position changes by no more than the velocity limit allows in the elapsed time.

        Parameters
        ----------
        targets
            Targets of the n joints.
        last_rad
            Target positions of the previous period (n,).
        elapsed_s
            Time since the previous period.

        """
        way_rad = self.velocity_rad_s * elapsed_s
        position_rad = _between(targets.positions_rad, last_rad - way_rad, last_rad + way_rad)
        return JointTargets(
            _between(position_rad, self.lower_rad, self.upper_rad),
            _between(targets.velocities_rad_s, -self.velocity_rad_s, self.velocity_rad_s),
            _between(targets.efforts_nm, -self.effort_nm, self.effort_nm),
        )


def _between(values: Array, low: Array, high: Array) -> Array:
    """Clamp values; np.clip is several times slower."""
    clipped: Array = np.minimum(np.maximum(values, low), high)
    return clipped


class Backend(Protocol):
    """
    Backend that moves robots, each named by its namespace; '' is a single robot.

    Time advances only in `step`, by one period with constant targets.
    """

    @property
    def robots(self) -> tuple[str, ...]:
        """Return the names of the robots."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the names of the actuated joints; all robots have the same."""

    @property
    def period_s(self) -> float:
        """Return the duration of a step."""

    def observe(self) -> Mapping[str, Observation]:
        """Read the sensors of every robot, or raise BackendError."""

    def step(self, targets: Mapping[str, JointTargets]) -> None:
        """
        Advance all robots by one period.

        Parameters
        ----------
        targets
            Joint targets by robot name; a robot without an entry keeps its last ones.

        """

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset all robots to their start poses, at rest; time continues.

        Parameters
        ----------
        keyframe
            The name of the posture that they take. An unknown one raises the backend's own error.

        """

    def close(self) -> None:
        """Release all resources; the backend cannot be used afterwards."""
