# SPDX-License-Identifier: Apache-2.0
"""Settings of the MuJoCo backend: time steps, sensor noise and latency."""

from __future__ import annotations

from dataclasses import dataclass, field

from humanoid_simulation.backend.noise import SensorNoise
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.description import Physics


@dataclass(frozen=True)
class BackendSettings:
    """Settings of the physics, and imperfections of sensors and drives."""

    physics: Physics = field(default_factory=Physics)
    steps_per_period: int = 5
    """Physics steps in a control period, from one observation to the next."""
    noise: SensorNoise = field(default_factory=SensorNoise)
    seed: int = 0
    """Seed of the noise: the same seed gives the same trajectory, bit for bit."""
    latency_periods: int = 0
    """Age of observations, in control periods."""
    extrapolation_s: float = 0.0
    """How long positions are extrapolated at their target velocities without new targets."""

    def __post_init__(self) -> None:
        """Validate the ranges of the settings."""
        if not 1 <= self.steps_per_period <= 100:
            raise SimulationError(
                f'A period cannot have {self.steps_per_period} physics steps. Give 1 to 100.'
            )
        if not 0 <= self.latency_periods <= 100:
            raise SimulationError(
                f'Observations cannot be {self.latency_periods} periods old. Give 0 to 100.'
            )
        if not 0.0 <= self.extrapolation_s <= 1.0:
            raise SimulationError(
                f'Targets cannot be extrapolated for {self.extrapolation_s:g} s. Give 0 to 1.'
            )

    @property
    def period_s(self) -> float:
        """Return the control period: the time from one observation to the next."""
        return self.steps_per_period * self.physics.period_s
