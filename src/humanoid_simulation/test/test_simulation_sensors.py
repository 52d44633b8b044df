# SPDX-License-Identifier: Apache-2.0
"""What sensors say, and how far they are off."""

from __future__ import annotations

import math

from humanoid_control.backends import Observation
from humanoid_description.rotations import quaternion_from_rpy
from humanoid_simulation.backend import BackendSettings, EntityState, SensorNoise
from humanoid_simulation.backend.noise import channels_of, NoiseSource
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.quaternions import rotated
import numpy as np
import pytest

NOISE = SensorNoise(
    position_rad=1e-3,
    velocity_rad_s=0.05,
    effort_nm=0.5,
    tilt_rad=3e-3,
    angular_velocity_rad_s=0.01,
    acceleration_m_s2=0.1,
    foot_force_n=5.0,
    foot_torque_nm=0.2,
)

LEVEL = np.array([1.0, 0.0, 0.0, 0.0])


def measured(make_backend, noise: SensorNoise, ticks: int = 800) -> list[Observation]:
    """Return what is seen of a robot that stands."""
    backend = make_backend(settings=BackendSettings(noise=noise, seed=3))
    seen = []
    for _ in range(ticks):
        backend.step({})
        seen.append(backend.observe()[''])
    return seen


def test_the_noise_has_the_deviations_that_are_set(make_backend) -> None:
    """Of each kind of measurement, around what is true."""
    seen, true = measured(make_backend, NOISE), measured(make_backend, SensorNoise())
    expected = {
        'positions_rad': 1e-3,
        'velocities_rad_s': 0.05,
        'efforts_nm': 0.5,
        'angular_velocity_rad_s': 0.01,
        'linear_acceleration_m_s2': 0.1,
        'foot_forces_n': 5.0,
        'foot_torques_nm': 0.2,
        'orientation': 3e-3 / 2,
    }
    for kind, deviation in expected.items():
        errors = np.array([getattr(a, kind) - getattr(b, kind) for a, b in zip(seen, true)])
        if kind == 'orientation':
            errors = errors[:, 1:3]
        assert errors.std() == pytest.approx(deviation, rel=0.1), kind
        assert abs(errors.mean()) < 0.1 * deviation, kind


def drifted(noise: SensorNoise, seed: int, duration_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the turns (n, 3) by which attitudes are off after some time, and the biases."""
    turns, biases = [], []
    for number in range(400):
        source = NoiseSource(noise, 0, np.random.default_rng([seed, number]))
        for tick in range(round(duration_s / 0.1) + 1):
            errors, turn = source.draw(LEVEL, 0.1 * tick)
        turns.append(turn)
        biases.append(errors[channels_of(0).angular_velocity])
    return np.array(turns), np.array(biases)


def test_the_heading_drifts_with_the_gyroscope() -> None:
    """Without a compass the bias adds up in the heading; gravity bounds roll and pitch."""
    noise = SensorNoise(angular_velocity_bias_rad_s=2e-3)
    early, late = (drifted(noise, 1, duration_s) for duration_s in (5.0, 20.0))
    assert early[0][:, 2] == pytest.approx(early[1][:, 2] * 5.0)
    assert late[0][:, 2] == pytest.approx(late[1][:, 2] * 20.0)
    assert np.abs(late[0][:, :2]).max() < 0.01
    assert late[0][:, :2] == pytest.approx(early[0][:, :2], rel=0.05)


def test_the_stated_noise_of_the_inertial_sensor_is_the_true_one() -> None:
    """What covariances are made of is the deviation over many sensors, biases and all."""
    noise = SensorNoise(
        tilt_rad=3e-3,
        angular_velocity_rad_s=0.01,
        angular_velocity_bias_rad_s=2e-3,
        acceleration_bias_m_s2=0.05,
    )
    turns, rates = drifted(noise, 2, 12.0)
    said = noise.imu(0.1)
    assert turns[:, :2].std() == pytest.approx(said.tilt_rad, rel=0.15)
    assert turns[:, 2].std() == pytest.approx(math.sqrt(said.heading_variance_rad2(12.0)), rel=0.1)
    assert rates.std() == pytest.approx(said.angular_velocity_rad_s, rel=0.1)


def test_the_orientation_stays_a_rotation(make_backend) -> None:
    """With noise as well, the four numbers are those of a rotation."""
    for seen in measured(make_backend, NOISE.scaled(10.0), ticks=50):
        assert np.linalg.norm(seen.orientation) == pytest.approx(1.0, abs=1e-12)


def test_biases_last(make_backend) -> None:
    """A bias is drawn once: it does not average out."""
    bias = SensorNoise(angular_velocity_bias_rad_s=0.1, acceleration_bias_m_s2=0.5)
    seen, true = measured(make_backend, bias, 20), measured(make_backend, SensorNoise(), 20)
    for kind in ('angular_velocity_rad_s', 'linear_acceleration_m_s2'):
        errors = np.array([getattr(a, kind) - getattr(b, kind) for a, b in zip(seen, true)])
        assert np.abs(errors[0]).max() > 0.02
        assert errors == pytest.approx(np.tile(errors[0], (20, 1)))


def test_without_noise_all_is_exact(make_backend) -> None:
    """Joints, orientation and rates are those of the state at this very moment."""
    backend = make_backend()
    backend.apply_wrench('torso', (40.0, 20.0, 0.0), (0.0, 0.0, 10.0))
    for _ in range(15):
        backend.step({})
    seen, truth = backend.observe()[''], backend.ground_truth()
    assert (seen.orientation == truth.orientation).all()
    in_world = rotated(seen.angular_velocity_rad_s, truth.orientation)
    assert in_world == pytest.approx(truth.angular_velocity_rad_s, abs=1e-12)
    assert np.abs(seen.angular_velocity_rad_s).max() > 0.01


def test_in_free_fall_nothing_is_felt(make_backend) -> None:
    """An accelerometer measures specific force, which is zero for what falls."""
    backend = make_backend()
    aloft = EntityState(np.array([0.0, 0.0, 5.0]), quaternion_from_rpy(0.3, 0.2, 0.1))
    backend.set_entity_state('robot', aloft)
    assert (backend.observe()[''].orientation == aloft.orientation).all()
    for _ in range(30):
        backend.step({})
    seen = backend.observe()['']
    assert np.abs(seen.linear_acceleration_m_s2).max() < 0.5
    assert np.abs(seen.foot_forces_n).max() < 1e-9


@pytest.mark.parametrize('value', [-0.1, float('nan'), float('inf')])
def test_noise_that_cannot_be(value: float) -> None:
    """A deviation is a number from zero on."""
    with pytest.raises(SimulationError, match='tilt_rad cannot be'):
        SensorNoise(tilt_rad=value)
