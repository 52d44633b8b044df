# SPDX-License-Identifier: Apache-2.0
"""Check when periodic calls are due."""

from __future__ import annotations

from humanoid_common.periodic import LONGEST_DELAY_S, Ticks
import pytest

START_NS = 1_700_000_000_123_456_789


def due(ticks: Ticks, since_start_s: float) -> list[float]:
    """Return what is due so long after the start."""
    return list(ticks.due(START_NS + round(since_start_s * 1e9)))


def begun(rate_hz: float) -> Ticks:
    """Return ticks whose first moment was now."""
    ticks = Ticks(rate_hz)
    assert due(ticks, 0.0) == [0.0]
    return ticks


def test_nothing_is_due_within_a_period() -> None:
    """A call that comes early finds nothing to do."""
    ticks = begun(10.0)
    assert due(ticks, 0.05) == []
    assert due(ticks, 0.1) == [0.1]
    assert due(ticks, 0.1) == []


def test_late_calls_are_made_up_for() -> None:
    """After a pause all missed moments come, evenly spaced."""
    ticks = begun(10.0)
    assert due(ticks, 0.36) == [0.1, 0.2, 0.3]
    assert due(ticks, 0.41) == [0.4]


def test_a_long_pause_is_not_made_up_for_whole() -> None:
    """What is older than the limit is left out, and the spacing stays."""
    ticks = begun(10.0)
    moments = due(ticks, 100.0)
    assert len(moments) == pytest.approx(10 * LONGEST_DELAY_S, abs=2)
    assert all(time_s == pytest.approx(round(time_s, 1)) for time_s in moments)
    assert due(ticks, 100.1) == [pytest.approx(100.1)]


def test_the_mean_rate_holds_however_irregular_the_calls() -> None:
    """The count of moments depends on the time alone."""
    ticks = begun(50.0)
    calls_s = [0.013, 0.2, 0.21, 0.7, 1.4, 1.41, 2.0001]
    assert sum(len(due(ticks, now_s)) for now_s in calls_s) == 100


def test_a_clock_in_steps_gives_one_moment_a_period() -> None:
    """With a clock that goes by 10 ms, 50 Hz is due with every second step, however long."""
    ticks = begun(50.0)
    counts = [len(due(ticks, 0.01 * step)) for step in range(1, 10_001)]
    assert counts == [0, 1] * 5000


def test_a_clock_that_is_set_back() -> None:
    """The time that has passed goes on; what a new simulator says first is no reason to wait."""
    ticks = begun(10.0)
    assert due(ticks, 0.25) == [0.1, 0.2]
    assert due(ticks, -500.0) == []
    assert due(ticks, -499.9) == [0.3]
    assert ticks.passed_s(START_NS - round(499.9e9)) == pytest.approx(0.35)


def test_change_of_the_rate() -> None:
    """The next moment is a new period from now, and the time does not jump."""
    ticks = Ticks(10.0)
    ticks.set_rate(1.0, START_NS)
    assert due(ticks, 0.0) == [0.0]
    ticks.set_rate(10.0, START_NS + 500_000_000)
    assert due(ticks, 0.55) == []
    assert due(ticks, 0.7) == [pytest.approx(0.6), pytest.approx(0.7)]
