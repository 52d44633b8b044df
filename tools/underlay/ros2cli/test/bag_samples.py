# SPDX-License-Identifier: Apache-2.0
"""Recordings for the tests, made without ROS."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ament_index_python.packages import get_package_share_directory
from ros2bag.storage.bag_writer import BagWriter, WriterOptions
from ros2bag.storage.definitions import definition_of
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import Topic
from ros2bag.storage.offered_qos import OfferedQos
from rosbags.typesys import get_typestore, Stores

STORE = get_typestore(Stores.ROS2_JAZZY)
STRING, JOINTS = 'std_msgs/msg/String', 'sensor_msgs/msg/JointState'
LATCHED = OfferedQos(durability='transient_local')
MS = 1_000_000
START_NS = 1_700_000_000_000_000_000


def find_definition(type_name: str) -> Any:
    """Return the definition of an installed type."""
    return definition_of(type_name, get_package_share_directory)


def topic(name: str, type_name: str = STRING, qos: OfferedQos | None = None) -> Topic:
    """Return a topic with the hash that its publishers would name."""
    return Topic(name, type_name, STORE.hash_rihs01(type_name), (qos or OfferedQos(),))


def string(name: str, text: str, time_ns: int) -> RecordedMessage:
    """Return a recorded std_msgs/msg/String."""
    message = STORE.types[STRING](text)
    data = bytes(STORE.serialize_cdr(message, STRING))
    return RecordedMessage(name, data, START_NS + time_ns, START_NS + time_ns - 1)


def joints(name: str, positions: Iterable[float], time_ns: int) -> RecordedMessage:
    """Return a recorded sensor_msgs/msg/JointState."""
    import numpy as np

    types = STORE.types
    stamp = types['builtin_interfaces/msg/Time'](1, 2)
    header = types['std_msgs/msg/Header'](stamp, 'torso')
    values = np.array(list(positions))
    message = types[JOINTS](header, ['joint'] * len(values), values, values, values)
    data = bytes(STORE.serialize_cdr(message, JOINTS))
    return RecordedMessage(name, data, START_NS + time_ns, START_NS + time_ns - 1)


def start_bag(folder: Path, *topics: Topic, **options: Any) -> BagWriter:
    """Return a recording with topics and without messages."""
    writer = BagWriter(str(folder), WriterOptions(**options), find_definition)
    for each in topics:
        writer.set_topic(each)
    return writer


def write_bag(folder: Path, count: int = 20, period_ns: int = 10 * MS, **options: Any) -> None:
    """Write a recording of numbered texts on /ticks and one latched text on /description."""
    writer = start_bag(folder, topic('/ticks'), topic('/description', qos=LATCHED), **options)
    writer.write(string('/description', '<robot/>', 0))
    for number in range(count):
        writer.write(string('/ticks', str(number), number * period_ns))
    writer.close()


def texts(messages: Iterable[RecordedMessage], name: str) -> list[str]:
    """Return the texts of the messages of one topic."""
    return [
        STORE.deserialize_cdr(each.data, STRING).data for each in messages if each.topic == name
    ]
