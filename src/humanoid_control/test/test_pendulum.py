# SPDX-License-Identifier: Apache-2.0
"""Check the motion of the centre of mass: its model, its plan, its estimate and reference."""

from __future__ import annotations

import math

from humanoid_control.walking.errors import WalkingError
from humanoid_control.walking.pendulum import (
    ComObserver,
    ComReference,
    DcmPlan,
    GRAVITY_M_S2,
    Motion,
    Pendulum,
    ZmpSegment,
)
import numpy as np
import pytest
from scipy.integrate import solve_ivp

PENDULUM = Pendulum(0.7)
START = Motion(0.02 - 0.01j, 0.1 + 0.2j)
ZMP = 0.03 + 0.05j
RATE_1_S = 3.74
SEGMENTS = [
    ZmpSegment(0.1, 0j, 0.02 + 0.09j),
    ZmpSegment(0.42, 0.02 + 0.09j, 0.02 + 0.09j),
    ZmpSegment(0.1, 0.02 + 0.09j, 0.2 - 0.09j),
    ZmpSegment(0.42, 0.2 - 0.09j, 0.2 - 0.09j),
    ZmpSegment(0.5, 0.2 - 0.09j, 0.2 + 0j),
]
PLAN = DcmPlan(SEGMENTS, RATE_1_S)
TIMES_S = [0.0, 0.05, 0.1, 0.3, 0.55, 0.9, 1.3, 1.54]
OBSERVED = Motion(0.01 - 0.02j, 0.05j)
COMMANDED = 0.02 + 0j
STEPS_S = [0.01, 0.1, 0.002, 0.05, 0.0, 0.01]


def integrated(time_s: float) -> Motion:
    """Return the motion after a time, by Runge and Kutta."""
    square = GRAVITY_M_S2 / PENDULUM.height_m

    def slope(_: float, state: list[complex]) -> list[complex]:
        return [state[1], square * (state[0] - ZMP)]

    begin = [START.position_m, START.velocity_m_s]
    end = solve_ivp(slope, (0.0, time_s), begin, rtol=1e-10, atol=1e-12).y[:, -1]
    return Motion(*end)


@pytest.mark.parametrize('time_s', [0.005, 0.1, 0.5])
def test_motion_is_that_of_the_equation(time_s: float) -> None:
    """The closed form is the solution of c'' = g/h (c - p), over long times too."""
    expected = integrated(time_s)
    reached = PENDULUM.after(START, ZMP, time_s)
    assert reached.position_m == pytest.approx(expected.position_m, abs=1e-8)
    assert reached.velocity_m_s == pytest.approx(expected.velocity_m_s, abs=1e-8)


def test_one_long_step_is_many_short_ones() -> None:
    """A tick of 100 ms does what ten of 10 ms do."""
    motion = START
    for _ in range(10):
        motion = PENDULUM.after(motion, ZMP, 0.01)
    once = PENDULUM.after(START, ZMP, 0.1)
    assert motion.position_m == pytest.approx(once.position_m, abs=1e-14)
    assert motion.velocity_m_s == pytest.approx(once.velocity_m_s, abs=1e-14)


def test_dcm_diverges_exponentially() -> None:
    """The divergent component runs away from the zero-moment point as exp(w t)."""
    growth = math.exp(PENDULUM.rate_1_s * 0.3)
    expected = ZMP + (PENDULUM.dcm(START) - ZMP) * growth
    assert PENDULUM.dcm(PENDULUM.after(START, ZMP, 0.3)) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize('time_s', TIMES_S)
def test_plan_is_the_solution_backwards(time_s: float) -> None:
    """The reference is what the equation xi' = w (xi - p) gives, integrated from the end."""

    def slope(now_s: float, state: list[complex]) -> list[complex]:
        return [RATE_1_S * (state[0] - PLAN.at(now_s).zmp_m)]

    way = (PLAN.duration_s, time_s)
    end = [SEGMENTS[-1].end_m]
    expected = solve_ivp(slope, way, end, rtol=1e-9, atol=1e-11, max_step=0.01).y[0, -1]
    assert PLAN.at(time_s).dcm_m == pytest.approx(expected, abs=2e-6)


def test_plan_is_continuous() -> None:
    """Where one segment ends and the next begins, nothing jumps."""
    for time_s in (0.1, 0.52, 0.62, 1.04, 1.54):
        before, after = PLAN.at(time_s - 1e-9), PLAN.at(time_s + 1e-9)
        assert before.dcm_m == pytest.approx(after.dcm_m, abs=1e-7)
        assert before.zmp_m == pytest.approx(after.zmp_m, abs=1e-7)


def test_plan_rests_at_its_end() -> None:
    """After the plan, weight and divergent component are in the same place for ever."""
    for time_s in (PLAN.duration_s, 99.0):
        end = PLAN.at(time_s)
        assert end.dcm_m == end.zmp_m == SEGMENTS[-1].end_m


def test_before_the_plan_it_stands_still() -> None:
    """A time before the start is the start."""
    assert PLAN.at(-1.0) == PLAN.at(0.0)


def test_empty_plan_is_refused() -> None:
    """There is no plan without segments."""
    with pytest.raises(WalkingError, match='at least one segment'):
        DcmPlan([], RATE_1_S)


@pytest.mark.parametrize('rate_1_s', [0.0, 5.0, 60.0])
def test_perfect_measurements_stay(rate_1_s: float) -> None:
    """Where model and measurement agree, the estimate is both, after any times."""
    observer = ComObserver(PENDULUM, rate_1_s)
    truth = OBSERVED
    observer.update(truth, COMMANDED, 0.0)
    for step_s in STEPS_S:
        truth = PENDULUM.after(truth, COMMANDED, step_s)
        estimate = observer.update(truth, COMMANDED, step_s)
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
    observer = ComObserver(PENDULUM, 60.0, OBSERVED)
    measured = Motion(0.05 + 0j, -0.1j)
    estimate = observer.update(measured, COMMANDED, 0.1)
    assert abs(estimate.position_m - measured.position_m) < 1e-3


def test_reference_begins_at_rest() -> None:
    """The first reference is where the robot is, at rest."""
    reference = ComReference(PENDULUM, 8.0, 0.04)
    first = reference.update(OBSERVED, OBSERVED.position_m, 0.0)
    assert first == Motion(OBSERVED.position_m, 0j)


def test_reference_stays_near_the_robot() -> None:
    """A reference that the pendulum drives away is held at most so far from the robot."""
    reference = ComReference(PENDULUM, 8.0, 0.04)
    for _ in range(500):
        motion = reference.update(Motion(), -0.5 - 0.1j, 0.01)
    assert motion.position_m.real == pytest.approx(0.04)
    assert 0.0 < motion.position_m.imag <= 0.04


def test_reference_follows_a_pendulum() -> None:
    """If the robot moves as the pendulum does, so does the reference, after any times."""
    reference, truth = ComReference(PENDULUM, 8.0, 0.04, OBSERVED), OBSERVED
    for step_s in STEPS_S:
        truth = PENDULUM.after(truth, COMMANDED, step_s)
        motion = reference.update(truth, COMMANDED, step_s)
        assert motion.position_m == pytest.approx(truth.position_m, abs=1e-14)
