# SPDX-License-Identifier: Apache-2.0
"""Check the way of the foot through the air."""

from __future__ import annotations

from humanoid_control.walking.planar import PlanarPose
from humanoid_control.walking.swing_foot import Lift, lift_at, Planar, Swing, SwingFoot
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
    assert abs(foot.velocity.linear) < 1e-6
    assert abs(foot.velocity.angular) < 1e-6


@pytest.mark.parametrize('passed_s', [0.1, 0.2, 0.39])
def test_one_long_step_is_many_short_ones(passed_s: float) -> None:
    """A gap in the ticks does not change where the foot is."""
    once = flown([passed_s], [LANDING])
    often = flown([passed_s / 20] * 20, [LANDING] * 20)
    assert once.pose.position_m == pytest.approx(often.pose.position_m, abs=1e-9)
    assert once.velocity.linear == pytest.approx(often.velocity.linear, abs=1e-9)


def test_a_landing_that_moves_is_reached() -> None:
    """A foot whose landing moves on the way goes there without jumps on the way."""
    moved = LANDING.moved(0.05 - 0.03j)
    foot = flown([0.01] * 20, [LANDING] * 20)
    before = foot.velocity.linear, foot.acceleration.linear
    foot.advance(moved, 0.2, 1e-6)
    assert foot.velocity.linear == pytest.approx(before[0], abs=1e-4)
    assert foot.acceleration.linear == pytest.approx(before[1], abs=1e-3)
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
    pose, velocity, acceleration = foot.pose, foot.velocity, foot.acceleration
    foot.advance(LANDING, DURATION_S - 0.17, instant_s)
    moved_m = foot.pose.position_m - pose.position_m
    assert moved_m / instant_s == pytest.approx(velocity.linear, abs=1e-4)
    assert (foot.pose.yaw_rad - pose.yaw_rad) / instant_s == pytest.approx(
        velocity.angular, abs=1e-4
    )
    gained_m_s = foot.velocity.linear - velocity.linear
    assert gained_m_s / instant_s == pytest.approx(acceleration.linear, abs=1e-3)
    turned_rad_s = foot.velocity.angular - velocity.angular
    assert turned_rad_s / instant_s == pytest.approx(acceleration.angular, abs=1e-3)


def test_lift() -> None:
    """The foot is on the ground at both ends, at its highest in the middle, and not below."""
    for phase in (0.0, 1.0, 1.3):
        assert lift_at(0.05, phase, 2.5) == Lift()
    assert lift_at(0.05, 0.5, 2.5).height_m == pytest.approx(0.05)
    assert 0.0 < lift_at(0.05, 0.01, 2.5).height_m < 1e-4


@pytest.mark.parametrize('phase', [0.1, 0.4, 0.8])
def test_lift_rates_are_derivatives(phase: float) -> None:
    """Speed and acceleration are those of a phase that goes on at its rate."""
    rate_1_s, instant_s = 2.5, 1e-5
    before, now, after = (
        lift_at(0.05, phase + way * rate_1_s * instant_s, rate_1_s) for way in (-1, 0, 1)
    )
    speed = (after.height_m - before.height_m) / (2 * instant_s)
    assert now.speed_m_s == pytest.approx(speed, abs=1e-6)
    gain = (after.speed_m_s - before.speed_m_s) / (2 * instant_s)
    assert now.acceleration_m_s2 == pytest.approx(gain, abs=1e-6)


def test_spatial_motion() -> None:
    """Six numbers say how the sole moves: along x, y, z, then about them."""
    swing = Swing(0, LANDING, Lift(0.02, 0.3, -1.0), Planar(0.5 + 0.1j, 0.2), Planar(2 - 1j, 3.0))
    assert swing.velocity6.tolist() == [0.5, 0.1, 0.3, 0.0, 0.0, 0.2]
    assert swing.acceleration6.tolist() == [2.0, -1.0, -1.0, 0.0, 0.0, 3.0]
