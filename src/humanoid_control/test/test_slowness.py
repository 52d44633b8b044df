# SPDX-License-Identifier: Apache-2.0
"""Check when time is said to pass too slowly."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from humanoid_common.testing.ros import ros_sandbox
from humanoid_control.hosting import slowness
from humanoid_control.hosting.diagnostics import HostDiagnostics
from humanoid_control.hosting.slowness import Slowness, Speed
import pytest
from rcl_interfaces.msg import Log

SLOW, FAST = Speed(0.43, 1.0), Speed(0.97, 1.0)


def test_five_seconds_are_too_long() -> None:
    """A moment is forgiven, and what lasts is said, with both factors."""
    slowness = Slowness()
    assert [slowness.complaint(SLOW, now_s) for now_s in (10.0, 12.0, 14.9)] == ['', '', '']
    assert '0.43 instead of 1. The computer is too busy' in slowness.complaint(SLOW, 15.0)
    assert slowness.complaint(FAST, 16.0) == ''
    assert slowness.complaint(SLOW, 17.0) == ''


def test_a_pause_is_not_slow() -> None:
    """Nothing is known in a pause, and the patience begins anew after it."""
    slowness = Slowness()
    slowness.complaint(SLOW, 0.0)
    assert slowness.complaint(None, 4.0) == slowness.complaint(SLOW, 6.0) == ''


def test_what_was_asked_for_is_not_slow() -> None:
    """A tenth of real time may be wanted, and as fast as possible is never too slow."""
    assert not Speed(0.1, 0.1).is_slow and not Speed(0.01, 0.0).is_slow
    assert Speed(3.0, 4.0).is_slow


def test_it_is_logged_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is too slow for long is in each message of the diagnostics, and once in the log."""
    monkeypatch.setattr(slowness, 'PATIENCE_S', 0.0)
    load = SimpleNamespace(ticks=1, mean_ms=1.0, worst_ms=1.0, share=0.1)
    host: Any = SimpleNamespace(load=SimpleNamespace(report=lambda _: load), paused=False)
    robots: Any = SimpleNamespace(health=dict, time_s=1.0)
    logs: list[str] = []
    with ros_sandbox() as ros:
        node = ros.observer()
        node.create_subscription(Log, '/rosout', lambda log: logs.append(log.msg), 50)
        ros.wait_until(lambda: node.count_publishers('/rosout') > 0)
        diagnostics = HostDiagnostics(node, host, robots, lambda: SLOW)
        for _ in range(3):
            diagnostics.report()
        node.get_logger().info('over')
        ros.wait_until(lambda: 'over' in logs)
    slow = [each for each in logs if each.startswith('Slow: the real-time factor is 0.43')]
    assert len(slow) == 1 and slow[0].endswith('so that the world goes slower.')
