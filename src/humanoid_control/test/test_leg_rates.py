# SPDX-License-Identifier: Apache-2.0
"""Check the rates of a leg's joints for motions of its foot."""

from __future__ import annotations

from typing import Any

from humanoid_control.dynamics import (
    BodyModel,
    Frame,
    leg_posture,
    leg_rates,
    LegGeometry,
    Twist,
)
from humanoid_control.dynamics.rotations import exp, from_rpy
from humanoid_description.robot import Robot
import numpy as np
import pytest

Array = np.ndarray[Any, Any]
STEP_S = 1e-6
LINEAR, ANGULAR = np.array([0.3, -0.2, 0.5]), np.array([0.1, 0.4, -0.3])


@pytest.mark.parametrize('side', ['left', 'right'])
def test_rates_are_found_again(robot: Robot, side: str) -> None:
    """The rates that move a sole are found from its motion."""
    leg, generator = LegGeometry.of(robot, side), np.random.default_rng(7)
    model = BodyModel.of(robot, leg.joints)
    for _ in range(200):
        positions = generator.uniform(
            [-0.8, -0.6, -1.9, 0.2, -1, -0.5], [0.8, 0.6, 0.9, 2, 0.9, 0.5]
        )
        rates = generator.normal(size=6)
        state = model.state(np.eye(3), np.zeros(3), positions, rates)
        sole = Frame(state.position_m(leg.sole), state.rotation(leg.sole))
        twist = Twist(state.velocity_m_s(leg.sole), state.angular_velocity_rad_s(leg.sole))
        found = leg_rates(leg, leg_posture(leg, sole), sole, twist)
        assert found == pytest.approx(rates, rel=0, abs=1e-7)


@pytest.mark.parametrize('drop_m', [0.55, 0.598, 0.5985, 0.599, 0.6, 0.603, 0.607, 0.61])
def test_rates_are_the_derivative(robot: Robot, drop_m: float) -> None:
    """Within and beyond reach the rates are the derivative of the posture."""
    leg = LegGeometry.of(robot, 'left')
    rotation = from_rpy(0.1, -0.2, 0.3)
    place = leg.hip_m + drop_m * np.array([0.28, 0.0, -0.96]) - rotation @ leg.ankle_m

    def posture_at(time_s: float) -> Array:
        moved = Frame(place + LINEAR * time_s, exp(ANGULAR * time_s) @ rotation)
        return np.array(leg_posture(leg, moved).positions_rad)

    sole = Frame(place, rotation)
    found = leg_rates(leg, leg_posture(leg, sole), sole, Twist(LINEAR, ANGULAR))
    derivative = (posture_at(STEP_S) - posture_at(-STEP_S)) / (2 * STEP_S)
    assert found == pytest.approx(derivative, abs=1e-5)


@pytest.mark.parametrize('drop_m', [0.0, 0.6, 1.0, 10.0])
def test_rates_stay_finite(robot: Robot, drop_m: float) -> None:
    """A leg that is stretched far beyond its reach, or folded up, has finite rates."""
    leg = LegGeometry.of(robot, 'left')
    sole = Frame(leg.hip_m - leg.ankle_m - (0.0, 0.0, drop_m), np.eye(3))
    rates = leg_rates(leg, leg_posture(leg, sole), sole, Twist(LINEAR, ANGULAR))
    assert np.abs(rates).max() < 100.0
