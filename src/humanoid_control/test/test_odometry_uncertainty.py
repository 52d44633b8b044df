# SPDX-License-Identifier: Apache-2.0
"""Check the covariance that odometry states, against many dead reckonings that are off."""

from __future__ import annotations

import math

from humanoid_control.backends import ImuNoise
from humanoid_control.walking.odometry import _RISE_M2_M, _SCALE, _SLIP_M2_M, Uncertainty
from humanoid_control.walking.planar import PlanarPose
import numpy as np
import pytest

DRIFT_RAD_S, WALK_RAD = 3e-3, 4e-3
STEP_M, STEP_S, STEPS = 0.03, 0.1, 600
RUNS = 4000


def turned(number: int) -> float:
    """Return the heading at a step: an arc, then back."""
    return 0.005 * (number if number < STEPS / 2 else STEPS - number)


def test_it_is_that_of_many_dead_reckonings() -> None:
    """Positions and headings scatter as the covariance says, with their correlations."""
    random = np.random.default_rng(3)
    drift = random.normal(0.0, DRIFT_RAD_S, RUNS)
    scale = random.normal(0.0, _SCALE, RUNS)
    heading, place = np.zeros(RUNS), np.zeros(RUNS, dtype=complex)
    uncertainty, pose = Uncertainty(ImuNoise(0.0, 0.0, 0.0, DRIFT_RAD_S, WALK_RAD)), 0j
    uncertainty.update(PlanarPose(pose, turned(0)), 0.0)
    for number in range(STEPS):
        way = STEP_M * complex(math.cos(turned(number)), math.sin(turned(number)))
        pose += way
        uncertainty.update(PlanarPose(pose, turned(number + 1)), (number + 1) * STEP_S)
        place += way * np.exp(1j * heading) * (1.0 + scale)
        slip = random.normal(0.0, math.sqrt(_SLIP_M2_M * STEP_M), (2, RUNS))
        place += slip[0] + 1j * slip[1]
        heading += drift * STEP_S + random.normal(0.0, WALK_RAD * math.sqrt(STEP_S), RUNS)
    off = place - pose
    expected = np.cov(np.array([off.real, off.imag, heading]))
    stated = uncertainty.covariance[np.ix_((0, 1, 5), (0, 1, 5))]
    assert np.diag(stated) == pytest.approx(np.diag(expected), rel=0.15)
    spread = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    assert stated / spread == pytest.approx(expected / spread, abs=0.1)


def test_a_robot_that_stands_loses_its_heading_alone() -> None:
    """Time makes the heading uncertain, and only a way the position."""
    uncertainty = Uncertainty(ImuNoise(tilt_rad=0.01, heading_drift_rad_s=1e-3))
    for second in range(101):
        uncertainty.update(PlanarPose(), float(second))
    covariance = uncertainty.covariance
    assert covariance[5, 5] == pytest.approx(0.1**2, rel=0.01)
    assert covariance[0, 0] < 1e-5
    assert covariance[3, 3] == covariance[4, 4] == pytest.approx(1e-4)


def test_a_tilted_sensor_makes_the_robot_climb_ahead() -> None:
    """The height scatters with the way in the axes of the robot, and comes back with it."""
    random, bias_rad = np.random.default_rng(5), 5e-3
    uncertainty = Uncertainty(ImuNoise(tilt_rad=6e-3, tilt_bias_rad=bias_rad))
    pitch, roll = random.normal(0.0, bias_rad, (2, RUNS))
    height, place, yaw = np.zeros(RUNS), 0j, 0.0
    stated, true = list[float](), list[float]()
    for ahead, aside, turn in ((1.0, 0.0, 0.0), (0.0, 0.5, 0.2), (-0.5, 0.0, 0.0)):
        for _ in range(200):
            uncertainty.update(PlanarPose(place, yaw), STEP_S)
            # Half of the turn before the step and half after it.
            yaw += turn * 0.005
            place += STEP_M * complex(ahead, aside) * complex(math.cos(yaw), math.sin(yaw))
            yaw += turn * 0.005
            height += STEP_M * (ahead * pitch + aside * roll)
            rise_m2 = _RISE_M2_M * STEP_M * abs(complex(ahead, aside))
            height += random.normal(0.0, math.sqrt(rise_m2), RUNS)
        uncertainty.update(PlanarPose(place, yaw), STEP_S)
        stated.append(uncertainty.covariance[2, 2])
        true.append(float(height.var()))
    assert stated == pytest.approx(true, rel=0.1)


def test_it_is_a_covariance() -> None:
    """Symmetric and positive, whatever the way."""
    uncertainty = Uncertainty(ImuNoise(heading_drift_rad_s=0.01, heading_walk_rad_sqrt_s=0.01))
    random, place = np.random.default_rng(1), 0j
    for tick in range(500):
        place += complex(*random.normal(0.0, 0.05, 2))
        uncertainty.update(PlanarPose(place, float(random.uniform(-3, 3))), 0.1 * tick)
    covariance = uncertainty.covariance
    assert covariance == pytest.approx(covariance.T)
    assert np.linalg.eigvalsh(covariance).min() > 0.0
