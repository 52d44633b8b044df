# SPDX-License-Identifier: Apache-2.0
"""Check poses and headings in the ground plane."""

from __future__ import annotations

import math

from humanoid_control.walking.planar import cross, dot, limited, PlanarPose, smooth_turn
import pytest

POSE = PlanarPose(2 + 1j, math.pi / 2)


def test_ahead_and_left() -> None:
    """Ahead of a pose that faces along y is y, to its left is -x."""
    assert POSE.at(3.0, 1.0) == pytest.approx(1 + 4j)


def test_local_undoes_at() -> None:
    """A point seen from a pose is where it was put."""
    assert POSE.local(POSE.at(0.3, -0.7)) == pytest.approx(0.3 - 0.7j)


def test_halfway_turns_the_short_way() -> None:
    """Between 170 and -170 degrees lies 180, not 0."""
    middle = PlanarPose(0j, math.radians(170)).halfway(PlanarPose(2j, math.radians(-170)))
    assert middle.position_m == 1j
    assert abs(middle.yaw_rad) == pytest.approx(math.pi)


def test_products() -> None:
    """Scalar and cross product are those of vectors."""
    assert dot(1 + 2j, 3 + 4j) == 11
    assert cross(1 + 2j, 3 + 4j) == -2


def test_limits() -> None:
    """A value outside limits becomes the limit."""
    assert [limited(value, -1.0, 2.0) for value in (-5.0, 0.5, 5.0)] == [-1.0, 0.5, 2.0]


def test_turn_begins_and_ends_at_rest() -> None:
    """At both ends of a turn its rate is zero, and the ends are where they should be."""
    begin, end = smooth_turn(0.2, 0.8, 0.0, 0.5), smooth_turn(0.2, 0.8, 0.5, 0.5)
    assert (begin.heading_rad, begin.rate_rad_s) == (0.2, 0.0)
    assert (end.heading_rad, end.rate_rad_s) == pytest.approx((0.8, 0.0))


def test_rate_is_the_derivative() -> None:
    """The rate is the slope of the heading, and turns go the short way."""
    for time_s in (0.1, 0.25, 0.4):
        ends = [smooth_turn(3.0, -3.0, time_s + step_s, 0.5) for step_s in (-1e-6, 1e-6)]
        slope = (ends[1].heading_rad - ends[0].heading_rad) / 2e-6
        assert smooth_turn(3.0, -3.0, time_s, 0.5).rate_rad_s == pytest.approx(slope, abs=1e-6)
        assert slope > 0.0
