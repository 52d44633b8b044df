# SPDX-License-Identifier: Apache-2.0
"""The node of RViz with the executor of the programs."""

from __future__ import annotations

from collections.abc import Iterator
import time
from typing import Any

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.qos import QoSProfile
from rviz_common.guarded_node import GuardedNode
from rviz_common.polled_topic import PolledTopic
from std_msgs.msg import Int32
from tf2_ros.executing import make_executor

PATIENCE_S = 60.0


@pytest.fixture
def node() -> Iterator[GuardedNode]:
    """Return a node in a domain of its own, which works with an executor."""
    with domain_id() as domain:
        context = rclpy.Context()
        rclpy.init(context=context, domain_id=domain)
        node = GuardedNode('rviz2', context=context)
        executor = make_executor(context)
        executor.add_node(node)
        yield node
        executor.shutdown()
        node.destroy_node()
        context.try_shutdown()


def send(node: GuardedNode, done: Any) -> None:
    """Publish numbers until something is so."""
    publisher = node.create_publisher(Int32, 'numbers', 10)
    end_s, number = time.monotonic() + PATIENCE_S, 0
    while not done():
        assert time.monotonic() < end_s, 'it has not come true'
        publisher.publish(Int32(data=number))
        number += 1
        node.executor.spin_once(timeout_sec=0.05)


def test_polled_topics_are_left_to_who_polls(node: GuardedNode) -> None:
    """Messages of a polled topic are still there although the executor has worked."""
    polled = PolledTopic(node, Int32, 'numbers', QoSProfile(depth=3))
    heard: list[Int32] = []
    node.create_subscription(Int32, 'numbers', heard.append, 10)
    send(node, lambda: len(heard) > 5)
    taken = [message.data for message, _ in polled.take()]
    assert len(taken) == 3 and taken[-1] >= heard[-1].data
    polled.close()


def test_time_of_a_message(node: GuardedNode) -> None:
    """A callback that asks for it hears when a message came."""
    times_s: list[float] = []
    begin_s = time.time()
    node.create_subscription(
        Int32, 'numbers', lambda _, info: times_s.append(info['received_timestamp'] / 1e9), 10
    )
    send(node, lambda: bool(times_s))
    assert begin_s - 1.0 < times_s[0] < time.time() + 1.0


def test_a_callback_that_fails(node: GuardedNode) -> None:
    """The node goes on."""
    heard: list[int] = []

    def fail(message: Int32) -> None:
        heard.append(message.data)
        raise LookupError('a mistake')

    node.create_subscription(Int32, 'numbers', fail, 10)
    send(node, lambda: len(heard) > 2)
