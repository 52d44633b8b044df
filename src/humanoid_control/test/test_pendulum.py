# SPDX-License-Identifier: Apache-2.0
"""Check the inverted pendulum against the integrated equation of motion."""

from __future__ import annotations

import math

from humanoid_control.walking.pendulum import GRAVITY_M_S2, Motion, Pendulum
import pytest
from scipy.integrate import solve_ivp

PENDULUM = Pendulum(0.7)
START = Motion(0.02 - 0.01j, 0.1 + 0.2j)
ZMP = 0.03 + 0.05j


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
