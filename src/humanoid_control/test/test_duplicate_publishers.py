# SPDX-License-Identifier: Apache-2.0
"""Check that a second publisher of a topic is noticed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.hosting import duplicate_publishers
from humanoid_control.hosting.duplicate_publishers import DuplicatePublisherCheck
import pytest
from rcl_interfaces.msg import Log
from rclpy.node import Node
from sensor_msgs.msg import JointState


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def test_a_rival_is_said_once(ros: RosSandbox, monkeypatch: pytest.MonkeyPatch) -> None:
    """A second publisher is named, once as long as it stays, and again when it comes back."""
    monkeypatch.setattr(duplicate_publishers, 'PERIOD_S', 0.02)
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
        assert "Another node publishes '/joint_states', too" in said[-1]
        node.destroy_publisher(rival)
        ros.wait_until(lambda: node.count_publishers('joint_states') == 1, what='the end')
        _let_it_look(ros, node)


def _are_as_many(said: list[str], count: int) -> bool:
    return len(said) >= count


def _let_it_look(ros: RosSandbox, node: Node) -> None:
    """Let it look a few times."""
    ticks: list[None] = []
    timer = node.create_timer(duplicate_publishers.PERIOD_S, lambda: ticks.append(None))
    ros.wait_until(lambda: len(ticks) > 5, what='further looks')
    node.destroy_timer(timer)
