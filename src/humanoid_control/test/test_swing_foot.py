# SPDX-License-Identifier: Apache-2.0
"""Check the way of the foot through the air."""

from __future__ import annotations

from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.swing_foot import Lift, SoleMotion, SwingFoot
import pytest

LANDING = PlanarPose(0.3 + 0.1j, 0.4)
DURATION_S = 0.4


def flown(steps_s: list[float], landings: list[PlanarPose]) -> SwingFoot:
    """Return the foot after steps of time, each with its landing."""
    foot, left_s = SwingFoot(PlanarPose()), DURATION_S
    for step_s, landing in zip(steps_s, landings):
        foot.advance(landing, left_s, step_s)
        left_s -= step_s
    return foot


@pytest.mark.parametrize('rate_hz', [50, 100, 200])
def test_it_arrives_at_rest(rate_hz: int) -> None:
    """At the time of arrival the foot is above its landing and does not move, at any rate."""
    count = round(DURATION_S * rate_hz)
    foot = flown([1 / rate_hz] * count, [LANDING] * count)
    assert foot.pose.position_m == pytest.approx(LANDING.position_m, abs=1e-9)
    assert foot.pose.yaw_rad == pytest.approx(LANDING.yaw_rad, abs=1e-9)
    assert abs(foot.velocity_m_s) < 1e-6
    assert abs(foot.turn_rad_s) < 1e-6


@pytest.mark.parametrize('passed_s', [0.1, 0.2, 0.39])
def test_one_long_step_is_many_short_ones(passed_s: float) -> None:
    """A gap in the ticks does not change where the foot is."""
    once = flown([passed_s], [LANDING])
    often = flown([passed_s / 20] * 20, [LANDING] * 20)
    assert once.pose.position_m == pytest.approx(often.pose.position_m, abs=1e-9)
    assert once.velocity_m_s == pytest.approx(often.velocity_m_s, abs=1e-9)


def test_a_landing_that_moves_is_reached() -> None:
    """A foot whose landing moves on the way goes there without jumps."""
    moved = LANDING.moved(0.05 - 0.03j)
    foot = flown([0.01] * 20, [LANDING] * 20)
    speed_m_s, gain_m_s2 = foot.velocity_m_s, foot.acceleration_m_s2
    foot.advance(moved, 0.2, 1e-6)
    assert foot.velocity_m_s == pytest.approx(speed_m_s, abs=1e-4)
    assert foot.acceleration_m_s2 == pytest.approx(gain_m_s2, abs=1e-2)
    for tick in range(20):
        foot.advance(moved, 0.2 - 0.01 * tick, 0.01)
    assert foot.pose.position_m == pytest.approx(moved.position_m, abs=1e-9)


def test_it_turns_the_short_way() -> None:
    """From 3 rad to -3 rad it is 0.28 rad, not 6."""
    foot = SwingFoot(PlanarPose(0j, 3.0))
    foot.advance(PlanarPose(0j, -3.0), 0.4, 0.2)
    assert 3.0 < foot.pose.yaw_rad < 3.3


def test_velocity_and_acceleration_are_derivatives() -> None:
    """What the foot says of its motion is what it does."""
    instant_s = 1e-6
    foot = flown([0.17], [LANDING])
    before = SwingFoot(**vars(foot))
    foot.advance(LANDING, DURATION_S - 0.17, instant_s)
    moved_m = foot.pose.position_m - before.pose.position_m
    turned_rad = foot.pose.yaw_rad - before.pose.yaw_rad
    gained_m_s = foot.velocity_m_s - before.velocity_m_s
    gained_rad_s = foot.turn_rad_s - before.turn_rad_s
    assert moved_m / instant_s == pytest.approx(before.velocity_m_s, abs=1e-4)
    assert turned_rad / instant_s == pytest.approx(before.turn_rad_s, abs=1e-4)
    assert gained_m_s / instant_s == pytest.approx(before.acceleration_m_s2, abs=1e-3)
    assert gained_rad_s / instant_s == pytest.approx(before.turn_rad_s2, abs=1e-3)


def test_acceleration_of_the_sole() -> None:
    """Six numbers say how the sole accelerates: along x, y, z, then about them."""
    sole = SoleMotion(LANDING, acceleration_m_s2=2 - 1j, climb_m_s2=-0.5, turn_rad_s2=3.0)
    assert sole.acceleration.tolist() == [2.0, -1.0, -0.5, 0.0, 0.0, 3.0]


LIFT = Lift(0.05, 0.4, 0.2)


def test_lift() -> None:
    """The foot is on the ground at both ends, gently, and at its highest in the middle."""
    for time_s in (-0.1, 0.0, 0.4):
        assert LIFT.at(time_s)[:2] == pytest.approx((0.0, 0.0), abs=1e-12)
    assert LIFT.at(0.2)[:2] == pytest.approx((0.05, 0.0))


@pytest.mark.parametrize('order', [0, 1])
def test_climb_is_the_slope_of_the_height(order: int) -> None:
    """The rate of climb is the derivative of the height, and has one itself."""
    for time_s in (0.03, 0.15, 0.3, 0.45):
        slope = (LIFT.at(time_s + 1e-6)[order] - LIFT.at(time_s - 1e-6)[order]) / 2e-6
        assert LIFT.at(time_s)[order + 1] == pytest.approx(slope, abs=1e-6)


def test_late_ground_is_reached_for() -> None:
    """After the planned landing the foot goes on down."""
    assert LIFT.at(0.5) == pytest.approx((-0.02, -0.2, 0.0))


@pytest.mark.parametrize('rise_m', [0.02, -0.03])
def test_ground_of_another_height(rise_m: float) -> None:
    """The foot lands gently where the ground is expected, and clears both ends by as much."""
    assert LIFT.at(0.0, rise_m) == pytest.approx((0.0, 0.0, LIFT.at(0.0, rise_m)[2]))
    assert LIFT.at(0.4, rise_m)[:2] == pytest.approx((rise_m, 0.0), abs=1e-12)
    assert LIFT.at(0.2, rise_m)[0] - max(0.0, rise_m) >= 0.05 - 1e-12
    for time_s in (0.03, 0.2, 0.37):
        for order in (0, 1):
            after, before = (LIFT.at(time_s + step, rise_m)[order] for step in (1e-6, -1e-6))
            slope = (after - before) / 2e-6
            assert LIFT.at(time_s, rise_m)[order + 1] == pytest.approx(slope, abs=1e-6)


def test_the_foot_reaches_only_so_deep() -> None:
    """It waits there for the ground."""
    lift = Lift(0.05, 0.4, 0.2, deepest_m=0.03)
    assert lift.at(0.5, 0.01) == pytest.approx((-0.01, -0.2, 0.0))
    assert lift.at(0.9, 0.01) == pytest.approx((-0.02, 0.0, 0.0))
