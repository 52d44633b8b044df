# SPDX-License-Identifier: Apache-2.0
"""Sensor noise: white noise and constant biases of the channels of a robot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
import math

from humanoid_control.backends import Array, ImuNoise
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.quaternions import rotated
import numpy as np


@dataclass(frozen=True)
class SensorNoise:
    """Standard deviations of the white noise of measurements, and of the constant biases."""

    position_rad: float = 0.0
    velocity_rad_s: float = 0.0
    effort_nm: float = 0.0
    tilt_rad: float = 0.0
    """Noise of roll and pitch; the heading is integrated from the angular velocity."""
    angular_velocity_rad_s: float = 0.0
    acceleration_m_s2: float = 0.0
    foot_force_n: float = 0.0
    foot_torque_nm: float = 0.0
    angular_velocity_bias_rad_s: float = 0.0
    acceleration_bias_m_s2: float = 0.0

    def __post_init__(self) -> None:
        """Check that each standard deviation is finite and not negative."""
        for each in fields(self):
            value = getattr(self, each.name)
            if not (math.isfinite(value) and value >= 0.0):
                raise SimulationError(
                    f'The noise {each.name} cannot be {value:g}. Give zero or more.'
                )

    def imu(self, period_s: float) -> ImuNoise:
        """
        Summarise the errors of the inertial measurement unit for state estimation.

        Parameters
        ----------
        period_s
            Sampling period: the time from one measurement to the next.

        """
        tilt_bias_rad = math.hypot(
            self.angular_velocity_bias_rad_s * ATTITUDE_FILTER_S,
            self.acceleration_bias_m_s2 / GRAVITY_M_S2,
        )
        return ImuNoise(
            tilt_rad=math.hypot(self.tilt_rad, tilt_bias_rad),
            angular_velocity_rad_s=math.hypot(
                self.angular_velocity_rad_s, self.angular_velocity_bias_rad_s
            ),
            acceleration_m_s2=math.hypot(self.acceleration_m_s2, self.acceleration_bias_m_s2),
            heading_drift_rad_s=self.angular_velocity_bias_rad_s,
            heading_walk_rad_sqrt_s=self.angular_velocity_rad_s * math.sqrt(period_s),
            tilt_bias_rad=tilt_bias_rad,
        )

    def scaled(self, factor: float) -> SensorNoise:
        """
        Scale all standard deviations, including those of the biases.

        Parameters
        ----------
        factor
            Factor by which they are multiplied; 0 is no noise.

        Raises
        ------
        SimulationError
            The factor is negative or not finite.

        """
        return SensorNoise(*(factor * float(getattr(self, each.name)) for each in fields(self)))


REALISTIC = SensorNoise(
    position_rad=5e-4,
    velocity_rad_s=0.05,
    effort_nm=0.5,
    tilt_rad=3e-3,
    angular_velocity_rad_s=0.01,
    acceleration_m_s2=0.1,
    foot_force_n=5.0,
    foot_torque_nm=0.2,
    angular_velocity_bias_rad_s=2e-3,
    acceleration_bias_m_s2=0.05,
)
"""Typical of encoders, of a low-cost inertial measurement unit and of strain gauges."""

ATTITUDE_FILTER_S = 1.0
"""Time constant with which the attitude filter of the sensor follows the accelerometers."""
GRAVITY_M_S2 = 9.81
_PINION_M = 0.04
"""Radius of the pinion on which an encoder measures a prismatic joint."""


class NoiseSource:
    """
    Random errors of the measurements of a robot with n driven joints.

    Parameters
    ----------
    noise
        Standard deviations of the errors.
    joints
        Number n of driven joints.
    random
        Random number generator; the constant biases are drawn from it immediately.
    slides
        Whether each joint (n,) is prismatic, measured in m; empty if none is.

    Attributes
    ----------
    is_silent
        Whether all errors are zero.

    """

    def __init__(
        self,
        noise: SensorNoise,
        joints: int,
        random: np.random.Generator,
        slides: Sequence[bool] = (),
    ) -> None:
        self._random = random
        self._channels = channels_of(joints)
        self._deviations = _deviations(noise, self._channels)
        for place in np.flatnonzero(slides):
            for channel in (self._channels.positions, self._channels.velocities):
                self._deviations[channel][place] *= _PINION_M
        self._biases = _biases(noise, self._channels, random)
        self._tilt_rad = noise.tilt_rad
        self._attitude = AttitudeError(self._biases[self._channels.acceleration])
        self.is_silent = noise == SensorNoise()

    def draw(self, orientation: Array, time_s: float) -> tuple[Array, Array]:
        """
        Draw the errors of a measurement.

        Parameters
        ----------
        orientation
            True orientation of the inertial sensor, w, x, y, z.
        time_s
            Time of the measurement.

        Returns
        -------
        tuple[Array, Array]
            The errors of the channels (3 n + 18,), and that of the orientation: a small rotation
            vector (3,) in world axes.

        """
        errors = self._random.standard_normal(len(self._deviations)) * self._deviations
        errors += self._biases
        rates = rotated(errors[self._channels.angular_velocity], orientation)
        turn = self._attitude.update(rates, orientation, time_s)
        turn[:2] += self._random.standard_normal(2) * self._tilt_rad
        return errors, turn


class AttitudeError:
    """
    Error of the attitude that a filter estimates from gyroscopes and accelerometers (6 axes).

    The filter integrates the angular velocity, and corrects its tilt towards the vertical that
    the accelerometers measure. Its tilt error therefore stays bounded: by the gyroscope drift over
    the filter's time constant, and by the angle by which the accelerometer bias turns gravity. No
    magnetometer corrects the heading, so gyroscope errors accumulate in it.
    First-order complementary filter, linearised: Mahony, Hamel and Pflimlin, "Nonlinear
    Complementary Filters on the Special Orthogonal Group" (2008).

    Parameters
    ----------
    acceleration_bias_m_s2
        Bias (3,) of the accelerometers, in the axes of the sensor.

    """

    def __init__(self, acceleration_bias_m_s2: Array) -> None:
        self._bias = acceleration_bias_m_s2
        self._error_rad: Array | None = None
        self._time_s = 0.0

    def update(self, rate_error_rad_s: Array, orientation: Array, time_s: float) -> Array:
        """
        Advance the attitude error to the given time.

        Parameters
        ----------
        rate_error_rad_s
            Error (3,) of the angular velocity, in world axes.
        orientation
            True orientation of the sensor, w, x, y, z.
        time_s
            Current time. At the first call the filter has settled.

        Returns
        -------
        Array
            Rotation vector (3,) from the true attitude to that of the filter, in world axes.

        """
        x, y, _ = (rotated(self._bias, orientation) / GRAVITY_M_S2).tolist()
        leaning = np.array([y, -x, 0.0])
        if self._error_rad is None:
            self._error_rad, self._time_s = leaning, time_s
        passed_s = time_s - self._time_s
        self._time_s = time_s
        error: Array = self._error_rad + rate_error_rad_s * passed_s
        error[:2] += (leaning - error)[:2] * -math.expm1(-passed_s / ATTITUDE_FILTER_S)
        self._error_rad = error
        result: Array = error.copy()
        return result


def _deviations(noise: SensorNoise, channels: Channels) -> Array:
    """Return the standard deviation of each channel."""
    result = np.empty(channels.size)
    result[channels.positions] = noise.position_rad
    result[channels.velocities] = noise.velocity_rad_s
    result[channels.efforts] = noise.effort_nm
    result[channels.angular_velocity] = noise.angular_velocity_rad_s
    result[channels.acceleration] = noise.acceleration_m_s2
    result[channels.forces] = noise.foot_force_n
    result[channels.torques] = noise.foot_torque_nm
    return result


def _biases(noise: SensorNoise, channels: Channels, random: np.random.Generator) -> Array:
    """Draw the bias of each channel."""
    result = np.zeros(channels.size)
    angular, linear = random.standard_normal((2, 3))
    result[channels.angular_velocity] = angular * noise.angular_velocity_bias_rad_s
    result[channels.acceleration] = linear * noise.acceleration_bias_m_s2
    return result


@dataclass(frozen=True)
class Channels:
    """Slices of the measurement array, by quantity; feet in the order left, right."""

    positions: slice
    velocities: slice
    efforts: slice
    angular_velocity: slice
    acceleration: slice
    forces: slice
    torques: slice

    @property
    def size(self) -> int:
        """Return the number of values in the array."""
        return int(self.torques.stop)


def channels_of(joints: int) -> Channels:
    """
    Assign the measurements of a robot to slices of one array.

    Parameters
    ----------
    joints
        Number n of driven joints.

    Returns
    -------
    Channels
        Slices of an array (3 n + 18,).

    """
    parts = []
    at = 0
    for length in (joints, joints, joints, 3, 3, 6, 6):
        parts.append(slice(at, at + length))
        at += length
    return Channels(*parts)
