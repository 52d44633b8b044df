# SPDX-License-Identifier: Apache-2.0
"""Check how the robot's time is told by a clock."""

from __future__ import annotations

from humanoid_control.hosting.stamping import Stamps
import pytest


def test_regular_as_the_robot() -> None:
    """Jitter of the clock is not in the stamps."""
    stamps = Stamps()
    told = [stamps.stamp_s(100.0 + n * 0.01, 100.0 + n * 0.01 + n % 3 * 0.004) for n in range(9)]
    assert told == pytest.approx([100.0 + n * 0.01 for n in range(9)])


@pytest.mark.parametrize('jump_s', [3600.0, -3600.0])
def test_a_clock_that_is_set(jump_s: float) -> None:
    """After the clock was set, or the computer slept, stamps are near to the clock again."""
    stamps = Stamps()
    assert stamps.stamp_s(5000.0, 5000.0) == 5000.0
    assert stamps.stamp_s(5000.01, 5000.01 + jump_s) == pytest.approx(5000.01 + jump_s)
    assert stamps.stamp_s(5000.02, 5000.02 + jump_s) == pytest.approx(5000.02 + jump_s)


def test_a_clock_that_stands() -> None:
    """Nothing is told before it has a time, nor when it was left behind, until it goes on."""
    stamps = Stamps()
    assert stamps.stamp_s(0.0, 0.0) is None
    assert stamps.stamp_s(0.1, 0.0) is None
    assert stamps.stamp_s(1.0, 0.0) is None
    assert stamps.stamp_s(1.01, 700.0) == pytest.approx(700.0)
    assert stamps.stamp_s(2.0, 700.0) is None
    assert stamps.stamp_s(2.01, 700.01) == pytest.approx(700.01)
