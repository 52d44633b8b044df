# SPDX-License-Identifier: Apache-2.0
"""Tests of the wait for discovery, with a clock of our own."""

from collections.abc import Callable

from ros2cli.node.discovery import PATIENCE, PERIOD_S, QUIET_LOOKS, Snapshot, wait_until_stable
from ros2cli.node.neighbours import count_in_table

SPIN_S = 0.5
QUIET_S = PERIOD_S * QUIET_LOOKS - 1e-6


class FakeClock:
    """Time that passes only by sleeping."""

    def __init__(self) -> None:
        """Start at zero."""
        self.now_s = 0.0

    def sleep(self, duration_s: float) -> None:
        """Let time pass."""
        self.now_s += duration_s


def waited(at: Callable[[float], Snapshot], **options: Callable[[], object]) -> tuple[float, bool]:
    """Return how long a wait takes for a graph that is a function of time, and its result."""
    clock = FakeClock()
    settled = wait_until_stable(
        lambda: at(clock.now_s), SPIN_S, now_s=lambda: clock.now_s, sleep=clock.sleep, **options
    )
    return clock.now_s, settled


def test_complete_graph_ends_the_wait() -> None:
    """A graph that is known to be complete is waited for only as long as it must be quiet."""
    duration_s, settled = waited(lambda now: Snapshot('graph', True))
    assert QUIET_S <= duration_s < 2 * QUIET_S
    assert settled


def test_unknown_completeness_takes_spin_time() -> None:
    """Without knowledge about others the wait takes the spin time."""
    duration_s, settled = waited(lambda now: Snapshot('graph', None))
    assert SPIN_S <= duration_s < SPIN_S + QUIET_S
    assert settled


def test_change_prolongs_the_wait() -> None:
    """A change starts the quiet time anew."""
    duration_s, _ = waited(lambda now: Snapshot(now > 0.1, True))
    assert 0.1 + QUIET_S <= duration_s < 0.1 + 2 * QUIET_S


def test_incomplete_graph_ends_after_all() -> None:
    """A participant that never answers does not block for ever, but is reported."""
    duration_s, settled = waited(lambda now: Snapshot('graph', False))
    assert PATIENCE * SPIN_S <= duration_s < PATIENCE * SPIN_S + QUIET_S
    assert not settled


def test_slow_machine_gets_more_time() -> None:
    """Quiet is a number of looks, which take longer where sleeping takes longer."""
    clock = FakeClock()
    wait_until_stable(
        lambda: Snapshot('graph', True),
        SPIN_S,
        now_s=lambda: clock.now_s,
        sleep=lambda duration_s: clock.sleep(5 * duration_s),
    )
    assert clock.now_s >= 5 * QUIET_S


def test_done_ends_the_wait_at_once() -> None:
    """What is looked for ends the wait when it is there."""
    duration_s, settled = waited(lambda now: Snapshot('graph', False), is_done=lambda: True)
    assert duration_s == 0.0
    assert settled


def row(port: int, inode: int) -> str:
    """Return a row of the kernel's table of UDP sockets."""
    return f' 1: 00000000:{port:04X} 00000000:0000 07 00000000:00000000 00:0 0 0 0 {inode} 2 0 0'


def test_participants_are_counted_by_port() -> None:
    """The first port of each participant counts; own sockets and other domains do not."""
    rows = [row(17910, 1), row(17911, 1), row(17912, 2), row(7410, 3), row(17914, 4)]
    assert count_in_table(rows, {'4'}, domain_id=42) == 2
    assert count_in_table(rows, set(), domain_id=0) == 1
    assert count_in_table([], set(), domain_id=42) == 0
