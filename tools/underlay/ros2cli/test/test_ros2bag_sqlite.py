# SPDX-License-Identifier: Apache-2.0
"""Tests of bags in SQLite, which `rosbags` writes, and of older ones, which the tests write."""

from collections.abc import Callable
from pathlib import Path
import shutil
import sqlite3
from subprocess import CompletedProcess
from typing import Any

from bag_samples import MS, START_NS, STORE, STRING, string
import pytest
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.damage import BrokenFile
from rosbags.interfaces import (
    Qos,
    QosDurability,
    QosHistory,
    QosLiveliness,
    QosReliability,
    QosTime,
)
from rosbags.rosbag2 import StoragePlugin, Writer

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

COUNT = 20


def _write(folder: Path) -> None:
    """Write two topics, whose messages alternate, with `rosbags`."""
    forever = QosTime(2**31 - 1, 2**32 - 1)
    latched = Qos(
        QosHistory.KEEP_LAST, 1, QosReliability.RELIABLE, QosDurability.TRANSIENT_LOCAL,
        forever, forever, QosLiveliness.AUTOMATIC, forever, False,
    )  # fmt: skip
    with Writer(folder, version=9, storage_plugin=StoragePlugin.SQLITE3) as writer:
        topics = [
            writer.add_connection(name, STRING, typestore=STORE, offered_qos_profiles=[latched])
            for name in ('/a', '/b')
        ]
        for number in range(COUNT):
            message = string('', f'{number}', number * MS)
            writer.write(topics[number % 2], message.log_ns, message.data)


def _numbers(reader: BagReader, *topics: str, start_ns: int = 0) -> list[str]:
    return [
        STORE.deserialize_cdr(each.data, STRING).data
        for each in reader.messages(topics or None, start_ns)
    ]


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """Return the folder of a bag."""
    _write(tmp_path / 'bag')
    return tmp_path / 'bag'


def test_messages(bag: Path) -> None:
    """All are read in the order of time; some topics or a later part, too."""
    reader = BagReader(str(bag))
    reader.check()
    assert _numbers(reader) == [f'{number}' for number in range(COUNT)]
    assert _numbers(reader, '/b') == [f'{number}' for number in range(1, COUNT, 2)]
    assert _numbers(reader, start_ns=START_NS + 18 * MS) == ['18', '19']
    first = next(iter(reader.messages()))
    assert (first.topic, first.log_ns, first.publish_ns) == ('/a', START_NS, START_NS)
    assert reader.definitions()[STRING].text.strip().endswith('string data')


def test_a_single_file_describes_itself(bag: Path) -> None:
    """Without metadata.yaml its tables tell the same."""
    (path,) = bag.glob('*.db3')
    whole, alone = BagReader(str(bag)).metadata, BagReader(str(path)).metadata
    assert alone.storage_identifier == whole.storage_identifier == 'sqlite3'
    assert alone.span == whole.span and alone.span.message_count == COUNT
    assert alone.topics == whole.topics
    assert all(each.topic.is_latched for each in alone.topics)
    renamed = path.with_suffix('.bag')
    path.rename(renamed)
    assert BagReader(str(renamed)).metadata.span == whole.span


def test_reindex(ros2_here: Ros2, bag: Path) -> None:
    """`metadata.yaml` comes back; until then, the folder says how."""
    before = BagReader(str(bag)).metadata
    (bag / 'metadata.yaml').unlink()
    with pytest.raises(BagError, match='Recreate it with: ros2 bag reindex'):
        BagReader(str(bag))
    result = ros2_here('bag', 'reindex', str(bag), '-s', 'sqlite3')
    assert result.stdout == f'{bag}: {COUNT} messages; metadata.yaml is written\n'
    after = BagReader(str(bag)).metadata
    assert (after.topics, after.span) == (before.topics, before.span)
    assert after.storage_identifier == 'sqlite3'


def test_commands(ros2_here: Ros2, start_ros2: Start, bag: Path, tmp_path: Path) -> None:
    """`info` lists it, `play` publishes all of it, and `convert` writes it as MCAP."""
    info = ros2_here('bag', 'info', str(bag)).stdout
    assert 'Storage id:        sqlite3\n' in info and f'Messages:          {COUNT}\n' in info
    player = start_ros2('bag', 'burst', '-i', str(bag), 'sqlite3')
    _, errors = player.communicate(timeout=100)
    assert player.returncode == 0 and f'Played {COUNT} messages.' in errors
    options = tmp_path / 'out.yaml'
    new = tmp_path / 'new'
    options.write_text(f'output_bags:\n- uri: {new}\n  all_topics: true\n')
    done = ros2_here('bag', 'convert', '-i', str(bag), '-o', str(options))
    assert (done.returncode, done.stdout) == (0, f'{new}: {COUNT} messages\n')
    reader = BagReader(str(new))
    assert reader.metadata.storage_identifier == 'mcap'
    assert _numbers(reader) == _numbers(BagReader(str(bag)))


def test_oldest_tables(tmp_path: Path) -> None:
    """The first versions had neither QoS nor definitions nor a version."""
    path = tmp_path / 'old.db3'
    with sqlite3.connect(path) as database:
        database.executescript(
            'CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, '
            'serialization_format TEXT);'
            'CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, '
            'data BLOB);'
        )
        database.execute("INSERT INTO topics VALUES (1, '/a', ?, 'cdr')", (STRING,))
        for number in (2, 0, 1):
            each = string('/a', f'{number}', number * MS)
            database.execute(
                'INSERT INTO messages VALUES (NULL, 1, ?, ?)', (each.log_ns, each.data)
            )
    database.close()
    reader = BagReader(str(path))
    assert _numbers(reader) == ['0', '1', '2']
    (told,) = reader.metadata.topics
    assert (told.message_count, told.topic.offered_qos, told.topic.type_hash) == (3, (), '')
    assert reader.definitions() == {}


def test_faults_are_sentences(bag: Path, tmp_path: Path) -> None:
    """Of a damaged file, a missing one, and a database of something else."""
    (path,) = bag.glob('*.db3')
    damaged = tmp_path / 'damaged.db3'
    content = bytearray(path.read_bytes())
    content[100:] = b'\xff' * (len(content) - 100)
    damaged.write_bytes(content)
    with pytest.raises(BrokenFile, match=r"'.*damaged.db3' is damaged .*sqlite3 .* '.recover'"):
        BagReader(str(damaged))
    empty = tmp_path / 'empty.db3'
    empty.touch()
    with pytest.raises(BagError, match='is a database, but not one of a recording'):
        BagReader(str(empty))
    shutil.move(path, tmp_path / 'elsewhere.db3')
    with pytest.raises(BagError, match='is missing. To continue without it: ros2 bag reindex'):
        BagReader(str(bag)).check()
