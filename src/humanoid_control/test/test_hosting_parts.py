# SPDX-License-Identifier: Apache-2.0
"""Check the small parts of a host."""

from __future__ import annotations

from humanoid_common.parameters import build, ParameterError
from humanoid_control.hosting.host import Load
from humanoid_control.hosting.pacing import RateLimiter, RealTimePace, Stamps
from humanoid_control.hosting.parameters import HostParameters
from humanoid_control.hosting.reports import Refusals
import pytest


def test_every() -> None:
    """A rate is kept on the average, also when it does not divide that of the ticks."""
    due = RateLimiter(30.0)
    assert sum(due.is_due(tick * 0.01) for tick in range(1000)) == pytest.approx(300, abs=2)
    slow = RateLimiter(50.0)
    assert [slow.is_due(tick * 0.01) for tick in range(4)] == [True, False, True, False]


def test_every_tick_at_most() -> None:
    """What is missed is left out: once a tick is the most."""
    due = RateLimiter(100.0)
    assert due.is_due(0.0) and due.is_due(1.0) and not due.is_due(1.001)


def test_every_goes_on_after_a_clock_was_set_back() -> None:
    """What is due does not wait for a time that lies far ahead."""
    due = RateLimiter(50.0)
    assert due.is_due(1000.0) and due.is_due(10.0)
    assert not due.is_due(10.01) and due.is_due(10.02)


def test_never() -> None:
    """A rate of zero is never due."""
    assert not RateLimiter(0.0).is_due(5.0)


def test_pace() -> None:
    """Late ticks are made up for, but not those of long ago."""
    pace = RealTimePace(0.01)
    pace.restart(10.0)
    assert pace.wait_s(10.0) == 0.0
    pace.ticked(10.0)
    assert pace.wait_s(10.0) == pytest.approx(0.01)
    ticks = 0
    while pace.wait_s(15.0) == 0.0:
        pace.ticked(15.0)
        ticks += 1
    assert ticks in (10, 11)


def test_refusals() -> None:
    """A sentence is said once, and again when it was not heard for a while."""
    said: list[str] = []
    clock = [0.0]
    refusals = Refusals(said.append, lambda: clock[0])
    for now_s in (0.0, 0.02, 4.0, 8.0):
        clock[0] = now_s
        refusals.add('no')
    refusals.add('never')
    assert said == ['no', 'never']
    clock[0] = 20.0
    refusals.add('no')
    assert said == ['no', 'never', 'no']


def test_many_different_refusals() -> None:
    """A flood of sentences, all of them new, is cut off for a while, with a word on that."""
    said: list[str] = []
    clock = [0.0]
    refusals = Refusals(said.append, lambda: clock[0])
    for number in range(250):
        refusals.add(f'{number}')
    assert said[:2] == ['0', '1'] and len(said) == 11
    assert 'further ones are not logged' in said[-1]
    clock[0] = 6.0
    refusals.add('later')
    assert said[-1] == 'later'


def test_load() -> None:
    """The load is the share of the time that ticks take."""
    load = Load(100.0)
    for took_s in (0.01, 0.03):
        load.add(took_s)
    report = load.report(101.0)
    assert (report.ticks, report.mean_ms, report.worst_ms) == (2, pytest.approx(20.0), 30.0)
    assert report.share == pytest.approx(0.04)
    assert load.report(102.0).ticks == 0


@pytest.mark.parametrize(
    ('robots', 'reason'),
    [
        (['', 'robot1'], "contains '', which is not a valid namespace"),
        (['2nd'], "contains '2nd'"),
        (['a/b'], "contains 'a/b'"),
        (['a' * 300], 'up to 60 letters'),
        (['robot1', 'robot1'], "names 'robot1' more than once"),
    ],
)
def test_bad_names(robots: list[str], reason: str) -> None:
    """Names of robots that make no namespaces are refused."""
    with pytest.raises(ParameterError) as refusal:
        build(HostParameters, {'robots': robots})
    assert reason in str(refusal.value)


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
