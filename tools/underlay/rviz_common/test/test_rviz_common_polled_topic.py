# SPDX-License-Identifier: Apache-2.0
"""A topic whose messages wait."""

from __future__ import annotations

from collections.abc import Callable
import time
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile
from rviz_common.polled_topic import PolledTopic, rest_all, resume_all
from std_msgs.msg import Int32


def test_messages_wait(node: Node, spin_until: Callable[..., None]) -> None:
    """Messages are there when they are asked for, the newest ones if there are too many."""
    topic = PolledTopic(node, Int32, 'numbers', QoSProfile(depth=3))
    publisher = node.create_publisher(Int32, 'numbers', 10)
    spin_until(lambda: publisher.get_subscription_count() == 1)
    begin_s = time.time()
    for number in range(10):
        publisher.publish(Int32(data=number))
    taken: list[tuple[Any, float]] = []
    spin_until(lambda: taken.extend(topic.take()) or len(taken) >= 3)
    assert [message.data for message, _ in taken] == [7, 8, 9]
    assert all(begin_s - 0.1 < time_s < time.time() + 0.1 for _, time_s in taken)
    assert list(topic.take()) == []
    topic.close()
    assert list(node.subscriptions) == []


def test_rest(node: Node, spin_until: Callable[..., None]) -> None:
    """A topic that rests is not subscribed, forgets what waited, and is heard again after."""
    topic = PolledTopic(node, Int32, 'numbers', QoSProfile(depth=3))
    publisher = node.create_publisher(Int32, 'numbers', 10)
    spin_until(lambda: publisher.get_subscription_count() == 1)
    rest_all(node)
    spin_until(lambda: publisher.get_subscription_count() == 0)
    assert list(topic.take()) == []
    resume_all(node)
    spin_until(lambda: publisher.get_subscription_count() == 1)
    publisher.publish(Int32(data=5))
    taken: list[tuple[Any, float]] = []
    spin_until(lambda: taken.extend(topic.take()) or bool(taken))
    assert [message.data for message, _ in taken] == [5]
    topic.close()
    resume_all(node)
    assert list(node.subscriptions) == []
