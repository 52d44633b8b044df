# SPDX-License-Identifier: Apache-2.0
"""Filters of message_filters, without and with topics."""

from __future__ import annotations

from collections.abc import Iterator
import time
from typing import Any

from message_filters import (
    ApproximateTimeSynchronizer,
    Cache,
    Chain,
    SimpleFilter,
    Subscriber,
    TimeSynchronizer,
)
import pytest
import rclpy
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import Range
from std_msgs.msg import String


def at(seconds: float, frame: str = '') -> Range:
    """Return a message with a time stamp."""
    msg = Range()
    msg.header.stamp = Time(nanoseconds=round(seconds * 1e9)).to_msg()
    msg.header.frame_id = frame
    return msg


def seconds_of(*msgs: Any) -> tuple[float, ...]:
    """Return the time stamps of messages in s."""
    return tuple(Time.from_msg(msg.header.stamp).nanoseconds / 1e9 for msg in msgs)


def keep_times(f: SimpleFilter) -> list[tuple[float, ...]]:
    """Return a list that gets the time stamps of each output of a filter."""
    got: list[tuple[float, ...]] = []
    f.registerCallback(lambda *msgs: got.append(seconds_of(*msgs)))
    return got


def test_callbacks_get_messages_and_their_own_arguments() -> None:
    """A function gets the messages, then the arguments it was registered with."""
    f = SimpleFilter()
    got: list[tuple[Any, ...]] = []
    assert f.registerCallback(lambda *args: got.append(args), 'mine', 2) == 0
    assert f.registerCallback(lambda *args: got.append(args)) == 1
    f.signalMessage('a', 'b')
    assert got == [('a', 'b', 'mine', 2), ('a', 'b')]


def test_same_stamps() -> None:
    """TimeSynchronizer puts out one message of each filter, in the order of the filters."""
    first, second = SimpleFilter(), SimpleFilter()
    both = TimeSynchronizer([first, second], 2)
    got: list[tuple[str, ...]] = []
    both.registerCallback(lambda *msgs: got.append(tuple(msg.header.frame_id for msg in msgs)))
    second.signalMessage(at(1.0, 'right'))
    first.signalMessage(at(1.1, 'left'))
    assert got == []
    first.signalMessage(at(1.0, 'left'))
    assert got == [('left', 'right')]
    second.signalMessage(at(1.1, 'right'))
    assert len(got) == 2
    assert not any(both.queues)


def test_old_messages_are_dropped() -> None:
    """Each queue has at most queue_size messages; the oldest stamp goes first."""
    first, second = SimpleFilter(), SimpleFilter()
    both = TimeSynchronizer([first, second], 2)
    got = keep_times(both)
    for seconds in (3.0, 1.0, 2.0):
        first.signalMessage(at(seconds))
    second.signalMessage(at(1.0))
    second.signalMessage(at(3.0))
    assert got == [(3.0, 3.0)]


def test_similar_stamps() -> None:
    """ApproximateTimeSynchronizer takes the closest set within slop, and each message once."""
    filters = [SimpleFilter(), SimpleFilter(), SimpleFilter()]
    together = ApproximateTimeSynchronizer(filters, queue_size=5, slop=0.1)
    got = keep_times(together)
    filters[0].signalMessage(at(1.00))
    filters[0].signalMessage(at(1.06))
    filters[1].signalMessage(at(1.07))
    filters[2].signalMessage(at(1.30))
    assert got == []
    filters[2].signalMessage(at(1.08))
    assert got == [(1.06, 1.07, 1.08)]
    filters[2].signalMessage(at(1.05))
    assert len(got) == 1


@pytest.mark.parametrize(('other', 'is_put_out'), [(1.1, True), (1.100000001, False)])
def test_spread_of_a_set_is_at_most_slop(other: float, is_put_out: bool) -> None:
    """Stamps of a set may lie exactly slop apart, even if each is near the new message."""
    filters = [SimpleFilter(), SimpleFilter(), SimpleFilter()]
    got = keep_times(ApproximateTimeSynchronizer(filters, 5, 0.1))
    filters[0].signalMessage(at(1.0))
    filters[1].signalMessage(at(other))
    filters[2].signalMessage(at(1.05))
    assert bool(got) == is_put_out


def test_messages_without_header() -> None:
    """Without a header a message is left out, or gets the time of its arrival."""
    strict = [SimpleFilter(), SimpleFilter()]
    left_out: list[Any] = []
    ApproximateTimeSynchronizer(strict, 5, 60.0).registerCallback(lambda *m: left_out.append(m))
    lenient = [SimpleFilter(), SimpleFilter()]
    got: list[Any] = []
    filters = ApproximateTimeSynchronizer(lenient, 5, 60.0, allow_headerless=True)
    filters.registerCallback(lambda *m: got.append(m))
    for pair in (strict, lenient):
        pair[0].signalMessage(String(data='a'))
        pair[1].signalMessage(String(data='b'))
    assert left_out == []
    assert [[msg.data for msg in msgs] for msgs in got] == [['a', 'b']]


def test_cache() -> None:
    """A cache passes messages on, keeps the last ones and finds them by time."""
    source = SimpleFilter()
    cache = Cache(source, 3)
    passed = keep_times(cache)
    assert cache.getLast() is None
    assert cache.getLatestTime() is None
    assert cache.getOldestTime() is None
    for seconds in (1.0, 2.0, 3.0, 4.0):
        source.signalMessage(at(seconds))
    assert passed == [(1.0,), (2.0,), (3.0,), (4.0,)]
    second = Time(seconds=1)
    assert cache.getOldestTime() == Time.from_msg(at(2.0).header.stamp)
    assert cache.getLastestTime() == cache.getLatestTime() == Time.from_msg(at(4.0).header.stamp)
    assert seconds_of(*cache.getInterval(second, Time(seconds=3))) == (2.0, 3.0)
    assert seconds_of(cache.getElemAfterTime(at(2.5).header.stamp)) == (3.0,)
    assert seconds_of(cache.getElemBeforeTime(Time(nanoseconds=2_500_000_000))) == (2.0,)
    assert cache.getElemBeforeTime(second) is None
    assert cache.getElemAfterTime(Time(seconds=5)) is None
    assert seconds_of(cache.getLast()) == (4.0,)


class Numbered(SimpleFilter):
    """A filter that adds its number to a text."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self._number = number

    def connectInput(self, f: SimpleFilter) -> None:
        """Take the texts of a filter."""
        f.registerCallback(self.add)

    def add(self, text: str) -> None:
        """Put out a text with the number."""
        self.signalMessage(f'{text}{self._number}')


def test_chain() -> None:
    """What goes in passes all filters, however late they are added; another input replaces it."""
    source, other = SimpleFilter(), SimpleFilter()
    chain = Chain(source)
    got: list[str] = []
    chain.registerCallback(got.append)
    source.signalMessage('a')
    filters = [Numbered(1), Numbered(2)]
    assert [chain.addFilter(each) for each in filters] == [0, 1]
    source.signalMessage('b')
    chain.connectInput(other)
    source.signalMessage('c')
    other.signalMessage('d')
    chain.add('e')
    assert got == ['a', 'b12', 'd12', 'e12']
    assert [chain.getFilter(index) for index in (0, 1, 2, -1)] == [*filters, None, None]
    with pytest.raises(TypeError, match='SimpleFilter has no connectInput'):
        chain.addFilter(source)


def test_chain_of_a_cache() -> None:
    """A cache in a chain keeps what passes."""
    chain = Chain()
    chain.addFilter(Cache(None, 3))
    times = keep_times(chain)
    for second in (1.0, 2.0):
        chain.add(at(second))
    assert times == [(1.0,), (2.0,)]
    assert seconds_of(chain.getFilter(0).getLast()) == (2.0,)


@pytest.fixture
def node() -> Iterator[Node]:
    """Return a node in a context of its own."""
    context = rclpy.Context()
    rclpy.init(context=context)
    node = Node('filters', context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_topics_are_synchronized(node: Node) -> None:
    """Messages that arrive on topics come out as a set; the subscriber knows its topic."""
    left = Subscriber(node, Range, 'left')
    right = Subscriber(node, Range, 'right', qos_profile=5)
    assert left.getTopic() == 'left'
    assert left.topic_name == '/left'
    got = keep_times(ApproximateTimeSynchronizer([left, right], 10, 0.02))
    publishers = [node.create_publisher(Range, name, 10) for name in ('left', 'right')]
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    end_s = time.monotonic() + 20.0
    while not got and time.monotonic() < end_s:
        publishers[0].publish(at(7.0))
        publishers[1].publish(at(7.01))
        rclpy.spin_once(node, executor=executor, timeout_sec=0.1)
    executor.shutdown()
    assert set(got) == {(7.0, 7.01)}
