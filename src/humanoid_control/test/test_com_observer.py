# SPDX-License-Identifier: Apache-2.0
"""Check the estimate of the centre of mass, and its reference."""

from __future__ import annotations

from humanoid_control.walking.com_observer import ComObserver
from humanoid_control.walking.com_reference import ComReference
from humanoid_control.walking.pendulum import Motion, Pendulum
import numpy as np
import pytest

PENDULUM = Pendulum(0.7)
START = Motion(0.01 - 0.02j, 0.05j)
ZMP = 0.02 + 0j
STEPS_S = [0.01, 0.1, 0.002, 0.05, 0.0, 0.01]


@pytest.mark.parametrize('rate_1_s', [0.0, 5.0, 60.0])
def test_perfect_measurements_stay(rate_1_s: float) -> None:
    """Where model and measurement agree, the estimate is both, after any times."""
    observer = ComObserver(PENDULUM, rate_1_s)
    truth = START
    observer.update(truth, ZMP, 0.0)
    for step_s in STEPS_S:
        truth = PENDULUM.after(truth, ZMP, step_s)
        estimate = observer.update(truth, ZMP, step_s)
        assert estimate.position_m == pytest.approx(truth.position_m, abs=1e-14)
        assert estimate.velocity_m_s == pytest.approx(truth.velocity_m_s, abs=1e-14)


def test_noise_becomes_less() -> None:
    """The velocity is estimated with less error than it is measured with."""
    random = np.random.default_rng(4)
    observer, truth = ComObserver(PENDULUM, 60.0), Motion()
    measured, estimated = [], []
    for _ in range(2000):
        noise = 0.1 * complex(*random.normal(size=2))
        estimate = observer.update(Motion(0j, noise), 0j, 0.005)
        measured.append(abs(noise) ** 2)
        estimated.append(abs(estimate.velocity_m_s - truth.velocity_m_s) ** 2)
    assert sum(estimated) < 0.3 * sum(measured)


def test_a_gap_leaves_the_measurement() -> None:
    """After 100 ms without a tick the estimate is almost what is measured, and stable."""
    observer = ComObserver(PENDULUM, 60.0, START)
    measured = Motion(0.05 + 0j, -0.1j)
    estimate = observer.update(measured, ZMP, 0.1)
    assert abs(estimate.position_m - measured.position_m) < 1e-3


def test_reference_begins_at_rest() -> None:
    """The first reference is where the robot is, at rest."""
    reference = ComReference(PENDULUM, 8.0, 0.04)
    first = reference.update(START, START.position_m, 0.0)
    assert first == Motion(START.position_m, 0j)


def test_reference_stays_near_the_robot() -> None:
    """A reference that the pendulum drives away is held at most so far from the robot."""
    reference = ComReference(PENDULUM, 8.0, 0.04)
    for _ in range(500):
        motion = reference.update(Motion(), -0.5 - 0.1j, 0.01)
    assert motion.position_m.real == pytest.approx(0.04)
    assert 0.0 < motion.position_m.imag <= 0.04


def test_reference_follows_a_pendulum() -> None:
    """If the robot moves as the pendulum does, so does the reference, after any times."""
    reference, truth = ComReference(PENDULUM, 8.0, 0.04, START), START
    for step_s in STEPS_S:
        truth = PENDULUM.after(truth, ZMP, step_s)
        motion = reference.update(truth, ZMP, step_s)
        assert motion.position_m == pytest.approx(truth.position_m, abs=1e-14)
