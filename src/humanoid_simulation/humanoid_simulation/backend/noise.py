# SPDX-License-Identifier: Apache-2.0
"""How far sensors are off."""

from __future__ import annotations

from dataclasses import dataclass, fields
import math

from humanoid_control.backends import Array
from humanoid_simulation.backend.channels import Channels, channels_of
from humanoid_simulation.errors import SimulationError
import numpy as np


@dataclass(frozen=True)
class SensorNoise:
    """Standard deviations of what changes at every measurement, and of the constant biases."""

    position_rad: float = 0.0
    velocity_rad_s: float = 0.0
    effort_nm: float = 0.0
    tilt_rad: float = 0.0
    """Of the orientation, about each axis."""
    angular_velocity_rad_s: float = 0.0
    acceleration_m_s2: float = 0.0
    foot_force_n: float = 0.0
    foot_torque_nm: float = 0.0
    angular_velocity_bias_rad_s: float = 0.0
    acceleration_bias_m_s2: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what is no standard deviation."""
        for each in fields(self):
            value = getattr(self, each.name)
            if not (math.isfinite(value) and value >= 0.0):
                raise SimulationError(
                    f'The noise {each.name} cannot be {value:g}. Give a number from zero on.'
                )

    def scaled(self, factor: float) -> SensorNoise:
        """Return the same noise, so much stronger."""
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
"""About that of encoders, of a cheap inertial measurement unit, and of strain gauges."""


class NoiseSource:
    """Draws the errors of the measurements of a robot with n joints."""

    def __init__(self, noise: SensorNoise, joints: int, random: np.random.Generator) -> None:
        """Draw the biases, which last."""
        self._random = random
        self._deviations = _deviations(noise, channels_of(joints))
        self._biases = _biases(noise, channels_of(joints), random)
        self._tilt_rad = noise.tilt_rad
        self.is_silent = noise == SensorNoise()

    def draw(self) -> tuple[Array, Array]:
        """
        Return errors for a measurement.

        The first ones are of the channels (3 n + 18,); the others are a turn of the orientation,
        a vector (3,) in its axes.
        """
        errors = self._random.standard_normal(len(self._deviations)) * self._deviations
        errors += self._biases
        return errors, self._random.standard_normal(3) * self._tilt_rad


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
