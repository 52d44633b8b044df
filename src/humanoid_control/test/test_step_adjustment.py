# SPDX-License-Identifier: Apache-2.0
"""Check how landings move and hurry to catch the robot."""

from __future__ import annotations

import cmath
import math

from humanoid_control.walking.footsteps import FootstepPlanner
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.pendulum import BalanceReference, Motion, Pendulum
from humanoid_control.walking.planar import LEFT, PlanarPose
from humanoid_control.walking.step_adjustment import Adjustment, Residual, StepAdjuster
from humanoid_control.walking.support_polygon import SupportPolygon
import pytest

P = WalkParameters()
PENDULUM = Pendulum(0.7)
ADJUSTER = StepAdjuster(FootstepPlanner(P), PENDULUM.rate_1_s)
REMAINING_S = 0.25


def adjusted(error: complex, yaw_rad: float = 0.0, rate: float = 1.0) -> Adjustment:
    """Return the landing of the right foot for an error, seen from a left foot that is turned."""
    turn = cmath.rect(1.0, yaw_rad)
    support = PlanarPose(0.3 + 0.2j, yaw_rad)
    corners = [support.at(x, y) for x in (-0.06, 0.12) for y in (-0.04, 0.04)]
    zmp = support.at(0.015, 0.0)
    dcm = zmp + 0.02 * turn
    residual = Residual.of(
        BalanceReference(dcm, zmp),
        dcm + error * turn,
        P.balance.dcm_gain,
        SupportPolygon(corners),
        support,
    )
    nominal = PlanarPose(support.at(0.1, -0.18), yaw_rad)
    return ADJUSTER.adjusted(nominal, support, LEFT, residual, REMAINING_S, rate)


def shift(adjustment: Adjustment, yaw_rad: float = 0.0) -> complex:
    """Return how far a landing has moved, seen from the support."""
    support = PlanarPose(0.3 + 0.2j, yaw_rad)
    return support.local(adjustment.landing.position_m) - (0.1 - 0.18j)


@pytest.mark.parametrize('error', [0j, 0.03 + 0.01j, -0.02 - 0.02j])
def test_what_ankles_can_do_moves_no_landing(error: complex) -> None:
    """An error that the zero-moment point takes out within the foot leaves the plan alone."""
    assert shift(adjusted(error)) == pytest.approx(0, abs=1e-12)
    assert adjusted(error).rate == 1.0


def test_landing_is_where_the_error_will_be() -> None:
    """A push that the foot cannot take moves the landing by the error left at its end."""
    error, growth = 0.09, math.exp(PENDULUM.rate_1_s * REMAINING_S)
    can_do_m = 0.12 - 0.015
    left_m = error * growth - can_do_m * (growth - 1.0)
    expected_m = left_m - P.step_adjustment.dead_band_m
    assert 0.02 < expected_m < 0.3
    assert shift(adjusted(error + 0j)) == pytest.approx(expected_m, abs=1e-12)


def test_landing_catches_the_pendulum() -> None:
    """With the moved landing the divergent component is as far from the foot as planned."""
    error, lean = 0.09, 0.02
    zmp_m = 0.12
    start = Motion(0.015 + lean + error + 0j)
    end = PENDULUM.dcm(PENDULUM.after(start, zmp_m + 0j, REMAINING_S))
    growth = math.exp(PENDULUM.rate_1_s * REMAINING_S)
    planned = 0.015 + lean * growth
    moved_m = shift(adjusted(error + 0j)).real + P.step_adjustment.dead_band_m
    assert end.real - planned == pytest.approx(moved_m, abs=1e-9)


@pytest.mark.parametrize('yaw_rad', [0.7, -2.5])
def test_heading_does_not_matter(yaw_rad: float) -> None:
    """A robot that faces elsewhere steps in the same way, seen from its foot."""
    error = 0.09 - 0.05j
    expected = shift(adjusted(error))
    assert shift(adjusted(error, yaw_rad), yaw_rad) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize('error', [0.5, -0.5, 0.5j, -0.5j, 0.4 + 0.4j])
def test_landings_stay_within_reach(error: complex) -> None:
    """However hard the push, the foot lands where it can and never across the other one."""
    place = shift(adjusted(error)) + 0.1 - 0.18j
    assert abs(place.real) <= P.footsteps.most_length_m + 1e-12
    assert P.footsteps.least_width_m - 1e-12 <= -place.imag <= P.footsteps.most_width_m + 1e-12


def test_what_is_out_of_reach_is_hurried() -> None:
    """A step that cannot reach far enough goes faster, and never slower again."""
    assert adjusted(0.18 + 0j).rate > 1.0
    assert adjusted(0.5 + 0j).rate == P.step_adjustment.hurry_rates[-1]
    assert adjusted(0j, rate=1.6).rate == 1.6
