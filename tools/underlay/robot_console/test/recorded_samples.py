# SPDX-License-Identifier: Apache-2.0
"""Recordings for the tests, and a recording that needs no file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from rclpy.serialization import serialize_message
from ros2bag.storage.bag_writer import BagWriter, WriterOptions
from ros2bag.storage.definitions import Definition, definition_of
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import Topic
from ros2bag.storage.offered_qos import OfferedQos
from std_msgs.msg import String

STRING = 'std_msgs/msg/String'
LATCHED = OfferedQos(durability='transient_local')
MS, S = 1_000_000, 1_000_000_000
START_NS = 1_700_000_000 * S


def find_definition(type_name: str) -> Definition:
    """Return the definition of an installed type."""
    return definition_of(type_name, get_package_share_directory)


def topic(name: str, qos: OfferedQos | None = None) -> Topic:
    """Return a topic of texts."""
    return Topic(name, STRING, '', (qos or OfferedQos(),))


def text(name: str, content: str, at_ns: int) -> RecordedMessage:
    """Return a recorded text, at a time after the start."""
    data = serialize_message(String(data=content))
    return RecordedMessage(name, data, START_NS + at_ns, START_NS + at_ns)


def write_bag(folder: Path, *names: str, count: int = 20, period_ns: int = 100 * MS) -> None:
    """Write a recording of numbered texts, and of one latched text on /description."""
    writer = BagWriter(str(folder), WriterOptions(), find_definition)
    for each in (*map(topic, names), topic('/description', LATCHED)):
        writer.set_topic(each)
    writer.write(text('/description', '<robot/>', 0))
    for number in range(count):
        for name in names:
            writer.write(text(name, str(number), number * period_ns))
    writer.close()


class Tape:
    """A recording in memory: numbered texts, and a latched one after 500 ms."""

    def __init__(self, count: int = 100, period_ns: int = 100 * MS) -> None:
        """Make it."""
        numbers = [text('/ticks', str(each), each * period_ns) for each in range(count)]
        late = text('/description', 'late', 500 * MS)
        self._messages = sorted([*numbers, late], key=lambda each: each.log_ns)
        self.start_ns, self.end_ns = START_NS, self._messages[-1].log_ns

    def messages(self, start_ns: int) -> Iterator[RecordedMessage]:
        """Yield what is played, from a time on."""
        return (each for each in self._messages if each.log_ns >= start_ns)

    def latched(self, start_ns: int, end_ns: int) -> Iterator[RecordedMessage]:
        """Yield the latched messages from a time to another."""
        found = (each for each in self._messages if each.topic == '/description')
        return (each for each in found if start_ns <= each.log_ns < end_ns)
