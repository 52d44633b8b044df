# SPDX-License-Identifier: Apache-2.0
"""Tests of when recorded moments are due."""

from unittest.mock import Mock

import pytest
from ros2bag.api.pacing import ClockOutlet, Pacing


class Clock:
    """A clock that is set by hand."""

    now_ns = 5000

    def __call__(self) -> int:
        return self.now_ns


@pytest.fixture
def clock() -> Clock:
    """Return a new clock."""
    return Clock()


def test_recorded_time_passes_at_the_rate(clock: Clock) -> None:
    """At twice the rate, the wait is half as long."""
    pacing = Pacing(1000, 2.0, clock)
    assert pacing.wait_ns(1400) == 200
    clock.now_ns += 150
    assert pacing.wait_ns(1400) == 50
    assert pacing.recorded_now_ns == 1300
    clock.now_ns += 100
    assert pacing.wait_ns(1400) == -50


def test_pause_stops_recorded_time(clock: Clock) -> None:
    """After a pause it goes on where it was, however often the pause is announced."""
    pacing = Pacing(1000, 1.0, clock)
    clock.now_ns += 100
    pacing.hold()
    clock.now_ns += 10_000
    pacing.hold()
    assert pacing.recorded_now_ns == 1100
    pacing.release()
    pacing.release()
    assert (pacing.recorded_now_ns, pacing.wait_ns(1150)) == (1100, 50)


def test_rate_changes_from_now_on(clock: Clock) -> None:
    """A new rate does not change what has passed."""
    pacing = Pacing(1000, 1.0, clock)
    clock.now_ns += 100
    pacing.set_rate(0.5)
    clock.now_ns += 100
    assert (pacing.rate, pacing.recorded_now_ns) == (0.5, 1150)
    assert pacing.wait_ns(1200) == 100


def test_infinite_rate_never_waits(clock: Clock) -> None:
    """Everything is due at once."""
    pacing = Pacing(1000, float('inf'), clock)
    clock.now_ns += 1
    assert pacing.wait_ns(10**15) <= 0
    assert pacing.recorded_now_ns == 1000


def test_jump_goes_on_from_another_moment(clock: Clock) -> None:
    """A jump makes a moment the present one."""
    pacing = Pacing(1000, 1.0, clock)
    pacing.jump_to(9000)
    clock.now_ns += 10
    assert pacing.recorded_now_ns == 9010


def test_published_time_does_not_pass_the_next_message(clock: Clock) -> None:
    """A player that is late does not publish a time at which a message is still missing."""
    pacing = Pacing(1000, 1.0, clock)
    node = Mock()
    outlet = ClockOutlet(node, '/clock', 1e9)
    published = node.create_publisher.return_value.publish
    times = []
    for passed_ns in (100, 100, 500):
        clock.now_ns += passed_ns
        outlet.tick(pacing, next_ns=1250)
        times.append(published.call_args.args[0].clock.nanosec)
    assert times == [1100, 1200, 1250]
