# SPDX-License-Identifier: Apache-2.0
"""Bags written and read message by message, as in the tutorials."""

from __future__ import annotations

from pathlib import Path
import subprocess
import sys

import pytest
from rclpy.duration import Duration
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.time import Time
import rosbag2_py
from std_msgs.msg import Int32, String

START_NS = 1_700_000_000_000_000_000


def topic(name: str, kind: str) -> rosbag2_py.TopicMetadata:
    """Return the description of a topic."""
    return rosbag2_py._storage.TopicMetadata(
        id=0, name=name, type=f'std_msgs/msg/{kind}', serialization_format='cdr'
    )


@pytest.fixture
def bag(tmp_path: Path) -> str:
    """Write ten messages on each of two topics, and return the folder."""
    folder = str(tmp_path / 'my_bag')
    writer = rosbag2_py.SequentialWriter()
    options = rosbag2_py._storage.StorageOptions(
        uri=folder, storage_id='mcap', custom_data={'robot': 'humanoid'}
    )
    writer.open(options, rosbag2_py._storage.ConverterOptions('', ''))
    writer.create_topic(topic('/chatter', 'String'))
    writer.create_topic(topic('/count', 'Int32'))
    for number in range(10):
        time_ns = START_NS + number * 1000
        writer.write('/chatter', serialize_message(String(data=f'hello {number}')), time_ns)
        writer.write('/count', serialize_message(Int32(data=number)), time_ns + 1)
    writer.close()
    writer.close()
    return folder


def read(reader: rosbag2_py.SequentialReader) -> list[tuple[str, bytes, int]]:
    """Read all further messages."""
    read = []
    while reader.has_next():
        read.append(reader.read_next())
    return read


def opened(bag: str) -> rosbag2_py.SequentialReader:
    """Return a reader of a bag."""
    reader = rosbag2_py.SequentialReader()
    reader.open(rosbag2_py.StorageOptions(bag), rosbag2_py.ConverterOptions('cdr', 'cdr'))
    return reader


def test_messages_are_read_as_they_were_written(bag: str) -> None:
    """All messages come in order of time, with their topics and types."""
    reader = opened(bag)
    messages = read(reader)
    assert [name for name, _, _ in messages] == ['/chatter', '/count'] * 10
    assert [time_ns for _, _, time_ns in messages[:3]] == [START_NS, START_NS + 1, START_NS + 1000]
    assert deserialize_message(messages[2][1], String).data == 'hello 1'
    types = {each.name: each.type for each in reader.get_all_topics_and_types()}
    assert types == {'/chatter': 'std_msgs/msg/String', '/count': 'std_msgs/msg/Int32'}
    with pytest.raises(RuntimeError, match='no further message'):
        reader.read_next()


def test_filters_and_times(bag: str) -> None:
    """A filter holds from the next message on; seek goes to a time."""
    reader = opened(bag)
    reader.set_filter(rosbag2_py.StorageFilter(topics=['/count']))
    assert {name for name, _, _ in read(reader)} == {'/count'}
    reader.reset_filter()
    assert not reader.has_next()
    reader.seek(START_NS + 8000)
    assert len(read(reader)) == 4
    reader.seek(0)
    reader.set_filter(rosbag2_py.StorageFilter(regex='/ch.*'))
    first = reader.read_next()
    reader.reset_filter()
    assert (first[0], first[2]) == ('/chatter', START_NS)
    assert reader.has_next()
    assert reader.read_next()[::2] == ('/count', START_NS + 1)
    reader.set_filter(rosbag2_py.StorageFilter(exclude_topics=['/chatter']))
    assert {name for name, _, _ in read(reader)} == {'/count'}
    limited = rosbag2_py.SequentialReader()
    limited.open(
        rosbag2_py.StorageOptions(bag, start_time_ns=START_NS + 2000, end_time_ns=START_NS + 3000)
    )
    assert len(read(limited)) == 3


def test_metadata(bag: str) -> None:
    """Reader and Info give the metadata with times of rclpy."""
    for metadata in (opened(bag).get_metadata(), rosbag2_py.Info().read_metadata(bag, 'mcap')):
        assert metadata.message_count == 20
        assert metadata.starting_time == Time(nanoseconds=START_NS)
        assert metadata.duration == Duration(nanoseconds=9001)
        assert metadata.storage_identifier == 'mcap'
        assert metadata.bag_size > 0
        assert metadata.custom_data == {'robot': 'humanoid'}
        assert {
            each.topic_metadata.name: each.message_count
            for each in metadata.topics_with_message_count
        } == {'/chatter': 10, '/count': 10}


def test_reindexer_restores_metadata(bag: str) -> None:
    """Without metadata.yaml a bag is not found; the reindexer writes it from the files."""
    (Path(bag) / 'metadata.yaml').unlink()
    with pytest.raises(RuntimeError, match='ros2 bag recover'):
        opened(bag)
    rosbag2_py.Reindexer().reindex(rosbag2_py.StorageOptions(bag))
    assert len(read(opened(bag))) == 20


def test_bag_is_complete_when_the_program_ends(tmp_path: Path) -> None:
    """A program that never calls close leaves a bag that can be read."""
    program = (
        'import rosbag2_py, sys\n'
        'from rclpy.serialization import serialize_message\n'
        'from std_msgs.msg import Int32\n'
        'writer = rosbag2_py.SequentialWriter()\n'
        "writer.open(rosbag2_py.StorageOptions(sys.argv[1], 'mcap'), "
        "rosbag2_py.ConverterOptions('', ''))\n"
        "writer.create_topic(rosbag2_py.TopicMetadata(0, 'n', 'std_msgs/msg/Int32', 'cdr'))\n"
        "writer.write('n', serialize_message(Int32(data=7)), 5)\n"
    )
    bag = str(tmp_path / 'bag')
    subprocess.run([sys.executable, '-c', program, bag], check=True)
    assert [(name, time_ns) for name, _, time_ns in read(opened(bag))] == [('n', 5)]


def test_what_is_not_possible_is_said(bag: str, tmp_path: Path) -> None:
    """Errors say what to do instead."""
    reader, writer = rosbag2_py.SequentialReader(), rosbag2_py.SequentialWriter()
    with pytest.raises(RuntimeError, match='call open first'):
        reader.has_next()
    with pytest.raises(RuntimeError, match='supported here, only in mcap or sqlite3. Existing'):
        reader.open(rosbag2_py.StorageOptions(bag, 'rosbag_v2'))
    with pytest.raises(
        RuntimeError, match="format 'sqlite3' are not supported here, only in mcap"
    ):
        writer.open(rosbag2_py.StorageOptions(str(tmp_path / 'new'), 'sqlite3'))
    with pytest.raises(RuntimeError, match='does not exist'):
        reader.open_uri(str(tmp_path / 'nothing'))
    with pytest.raises(RuntimeError, match='already exists'):
        writer.open(rosbag2_py.StorageOptions(bag))
    writer.open(rosbag2_py.StorageOptions(str(tmp_path / 'new')))
    with pytest.raises(RuntimeError, match="create_topic for 'talk' before"):
        writer.write('talk', b'', 0)
    with pytest.raises(AttributeError, match='has no .Recorder. here: start `ros2 bag record`'):
        _ = rosbag2_py.Recorder
