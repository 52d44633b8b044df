# SPDX-License-Identifier: Apache-2.0
"""Check when periodic calls are due."""

from __future__ import annotations

from humanoid_common.ticks import LONGEST_DELAY_S, Ticks
import pytest


def test_nothing_is_due_before_the_first_period() -> None:
    """A call that comes early finds nothing to do."""
    ticks = Ticks(10.0, 5.0)
    assert list(ticks.due(5.05)) == []
    assert list(ticks.due(5.1)) == [pytest.approx(5.1)]
    assert list(ticks.due(5.1)) == []


def test_late_calls_are_made_up_for() -> None:
    """After a pause all missed moments come, evenly spaced."""
    ticks = Ticks(10.0, 0.0)
    assert list(ticks.due(0.36)) == pytest.approx([0.1, 0.2, 0.3])
    assert list(ticks.due(0.41)) == pytest.approx([0.4])


def test_a_long_pause_is_not_made_up_for_whole() -> None:
    """What is older than the limit is left out, and the spacing stays."""
    ticks = Ticks(10.0, 0.0)
    moments = list(ticks.due(100.0))
    assert len(moments) == pytest.approx(10 * LONGEST_DELAY_S, abs=2)
    assert all(time_s == pytest.approx(round(time_s, 1)) for time_s in moments)
    assert list(ticks.due(100.1)) == [pytest.approx(100.1)]


def test_the_mean_rate_holds_however_irregular_the_calls() -> None:
    """The count of moments depends on the time alone."""
    ticks = Ticks(50.0, 0.0)
    calls_s = [0.013, 0.2, 0.21, 0.7, 1.4, 1.41, 2.0001]
    assert sum(len(list(ticks.due(now_s))) for now_s in calls_s) == 100
