# SPDX-License-Identifier: Apache-2.0
"""Tests of how fast a simulated world is said to be."""

import math
import time
from types import SimpleNamespace

import pytest
from robot_console.real_time_factor import RealTimeFactor, STALE_S
from std_msgs.msg import Float64


@pytest.fixture(name='factor')
def _factor() -> RealTimeFactor:
    node = SimpleNamespace(create_subscription=lambda *arguments: None)
    return RealTimeFactor(node)  # type: ignore[arg-type]


def test_the_newest_factor_counts(factor: RealTimeFactor) -> None:
    """What was said last is true, until nobody says anything for a while."""
    now_s = time.monotonic()
    assert factor.factor(now_s) is None
    factor._hear(Float64(data=0.5))
    factor._hear(Float64(data=0.25))
    assert factor.factor(now_s + 1.0) == 0.25
    assert factor.factor(now_s + 2 * STALE_S) is None


def test_what_is_no_number_is_left_out(factor: RealTimeFactor) -> None:
    """A page could not read it."""
    factor._hear(Float64(data=math.nan))
    assert factor.factor(time.monotonic()) is None
