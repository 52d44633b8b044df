# SPDX-License-Identifier: Apache-2.0
"""Wait for messages, and pump them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from launch_testing_ros import DataRepublisher, MessagePump, WaitForTopics
import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32, String

TIMEOUT_S = 100.0


@pytest.fixture
def node() -> Iterator[Node]:
    """Return a node that publishes a text again and again, and a number once."""
    context = Context()
    rclpy.init(args=[], context=context)
    node = Node('talker', context=context)
    publisher = node.create_publisher(String, 'words', 10)
    node.create_timer(0.05, lambda: publisher.publish(String(data='hello')))
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_publisher(Int32, 'number', latched).publish(Int32(data=5))
    with MessagePump(node):
        yield node
    node.destroy_node()
    context.try_shutdown()


def test_messages(node: Node) -> None:
    """Messages of all topics are awaited and kept; a third item is a QoS profile."""
    seen: list[Any] = []
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    with WaitForTopics(
        [('words', String), ('number', Int32, latched)],
        timeout=TIMEOUT_S,
        messages_received_buffer_length=2,
        callback=lambda topic, message: seen.append(topic),
    ) as topics:
        assert topics.topics_received() == {'words', 'number'}
        assert topics.topics_not_received() == set()
        assert topics.received_messages('number') == [Int32(data=5)]
        assert 1 <= len(topics.received_messages('words')) <= 2
    assert {'words', 'number'} <= set(seen)
    with pytest.raises(KeyError, match='not among the topics: words, number'):
        topics.received_messages('other')


def test_nothing_comes(node: Node) -> None:
    """Without messages the wait ends in time, and the error names the topics."""
    topics = WaitForTopics([('silence', String)], timeout=0.2)
    assert not topics.wait()
    assert topics.topics_not_received() == {'silence'}
    topics.shutdown()
    topics.shutdown()
    with pytest.raises(RuntimeError, match=r'within 0.2 s: silence. The topics there are: .*/'):
        with WaitForTopics([('silence', String)], timeout=0.2):
            pass


def test_trigger() -> None:
    """What lets the messages come is called with the node and the other arguments."""
    publishers = []

    def begin(node: Node, *, text: str) -> None:
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        publishers.append(node.create_publisher(String, '/robot/answer', latched))
        node.create_timer(0.05, lambda: publishers[0].publish(String(data=text)))

    with WaitForTopics(
        [('answer', String)], timeout=TIMEOUT_S, trigger=begin, node_namespace='robot', text='yes'
    ) as topics:
        assert topics.received_messages('answer')[0].data == 'yes'


def test_one_qos_profile_for_all_topics(node: Node) -> None:
    """A message that was published before arrives if the profile asks for it."""
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    with WaitForTopics([('number', Int32)], timeout=TIMEOUT_S, qos_profile=latched) as topics:
        assert topics.received_messages('number') == [Int32(data=5)]


def test_messages_are_republished(node: Node) -> None:
    """Messages come out as the function changed them, and those that it drops do not."""
    count = iter(range(1_000_000))

    def every_other(message: String) -> String | None:
        return String(data=f'{message.data} again') if next(count) % 2 else None

    other = Node('changer', context=node.context)
    changer = DataRepublisher(other, 'words', 'changed_words', String, every_other)
    with MessagePump(other):
        with WaitForTopics([('changed_words', String)], timeout=TIMEOUT_S) as topics:
            assert topics.received_messages('changed_words')[0].data == 'hello again'
    assert changer.get_num_received() > changer.get_num_republished() > 0
    assert changer.get_republished()[0] == String(data='hello again')
    changer.shutdown()
    other.destroy_node()
    assert node.count_publishers('changed_words') == 0
