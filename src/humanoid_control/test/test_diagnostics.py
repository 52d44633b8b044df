# SPDX-License-Identifier: Apache-2.0
"""Check when a slow computer and a second publisher are noticed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from types import SimpleNamespace
from typing import Any

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.hosting import diagnostics
from humanoid_control.hosting.diagnostics import (
    DuplicatePublisherCheck,
    HostDiagnostics,
    Slowness,
    Speed,
)
import pytest
from rcl_interfaces.msg import Log
from rclpy.node import Node
from sensor_msgs.msg import JointState

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
    monkeypatch.setattr(diagnostics, 'PATIENCE_S', 0.0)
    load = SimpleNamespace(ticks=1, mean_ms=1.0, worst_ms=1.0, share=0.1)
    host: Any = SimpleNamespace(load=SimpleNamespace(report=lambda _: load), paused=False)
    robots: Any = SimpleNamespace(health=dict, time_s=1.0)
    logs: list[str] = []
    with ros_sandbox() as ros:
        node = ros.observer()
        node.create_subscription(Log, '/rosout', lambda log: logs.append(log.msg), 50)
        ros.wait_until(lambda: node.count_publishers('/rosout') > 0)
        slow_host = HostDiagnostics(node, host, robots, lambda: SLOW)
        for _ in range(3):
            slow_host.report()
        node.get_logger().info('over')
        ros.wait_until(lambda: 'over' in logs)
    slow = [each for each in logs if each.startswith('Slow: the real-time factor is 0.43')]
    assert len(slow) == 1 and slow[0].endswith('so simulated time runs slower.')


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def test_a_rival_is_said_once(ros: RosSandbox, monkeypatch: pytest.MonkeyPatch) -> None:
    """A second publisher is named, once as long as it stays, and again when it comes back."""
    monkeypatch.setattr(diagnostics, 'DUPLICATES_PERIOD_S', 0.02)
    said: list[str] = []
    node = ros.observer()
    node.create_subscription(Log, '/rosout', lambda message: said.append(message.msg), 10)
    node.create_publisher(JointState, 'joint_states', 1)
    DuplicatePublisherCheck(node, ['joint_states'])
    for count in (1, 2):
        rival = node.create_publisher(JointState, 'joint_states', 1)
        ros.wait_until(partial(_are_as_many, said, count), what='a warning')
        _let_it_look(ros, node)
        assert len(said) == count
        assert "Another node also publishes '/joint_states', so" in said[-1]
        node.destroy_publisher(rival)
        ros.wait_until(lambda: node.count_publishers('joint_states') == 1, what='the end')
        _let_it_look(ros, node)


def _are_as_many(said: list[str], count: int) -> bool:
    return len(said) >= count


def _let_it_look(ros: RosSandbox, node: Node) -> None:
    """Let it look a few times."""
    ticks: list[None] = []
    timer = node.create_timer(diagnostics.DUPLICATES_PERIOD_S, lambda: ticks.append(None))
    ros.wait_until(lambda: len(ticks) > 5, what='further looks')
    node.destroy_timer(timer)
