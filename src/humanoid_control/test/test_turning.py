# SPDX-License-Identifier: Apache-2.0
"""Check how the pelvis turns."""

from __future__ import annotations

from humanoid_control.walking.turning import smooth_turn
import pytest


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
