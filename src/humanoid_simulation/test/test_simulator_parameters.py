# SPDX-License-Identifier: Apache-2.0
"""The parameters of the simulator."""

from __future__ import annotations

from humanoid_common.parameters import build, ParameterError
from humanoid_simulation.backend.noise import REALISTIC, SensorNoise
from humanoid_simulation.simulator_parameters import SimulatorParameters
import pytest


def test_without_noise_by_default_and_realistic_on_request() -> None:
    """One number turns all noise on; a single one of its parts can be set."""
    assert build(SimulatorParameters, {}).noise == SensorNoise()
    assert build(SimulatorParameters, {'sensor_noise': 1.0}).noise == REALISTIC
    louder = build(SimulatorParameters, {'sensor_noise': 2.0, 'foot_force_noise_n': 10.0}).noise
    assert louder.foot_force_n == 20.0
    assert louder.tilt_rad == 2.0 * REALISTIC.tilt_rad


@pytest.mark.parametrize(
    ('physics_hz', 'control_hz', 'steps'), [(500.0, 100.0, 5), (1000.0, 200.0, 5), (500, 500, 1)]
)
def test_a_period_has_whole_steps(physics_hz: float, control_hz: float, steps: int) -> None:
    """As many as the rates say."""
    values = {'physics_rate_hz': float(physics_hz), 'control_rate_hz': float(control_hz)}
    assert build(SimulatorParameters, values).steps_per_period == steps


@pytest.mark.parametrize(
    ('values', 'sentence'),
    [
        ({'physics_rate_hz': 500.0, 'control_rate_hz': 150.0}, 'not a multiple'),
        ({'physics_rate_hz': 100.0, 'control_rate_hz': 200.0}, 'not a multiple'),
        ({'robots': ('a', 'a')}, 'more than once'),
        ({'self_collision': 'legs'}, 'self_collision'),
        ({'real_time_factor': -1.0}, 'real_time_factor'),
        ({'real_time_factor': 1e-300}, 'Give 0.001 or more, or 0'),
    ],
)
def test_parameters_that_cannot_be(values, sentence: str) -> None:
    """The error names the parameter."""
    with pytest.raises(ParameterError, match=sentence):
        build(SimulatorParameters, values)
