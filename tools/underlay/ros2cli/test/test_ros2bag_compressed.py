# SPDX-License-Identifier: Apache-2.0
"""Tests of bags that other recorders have compressed, as `rosbags` compresses them."""

from pathlib import Path
from typing import Any

from bag_samples import MS, START_NS, STORE, STRING, string
import pytest
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.bags import Bags
from ros2bag.storage.damage import BrokenFile
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

COUNT = 20

both_storages = pytest.mark.parametrize('storage', [StoragePlugin.MCAP, StoragePlugin.SQLITE3])


def _write(folder: Path, storage: Any, mode: CompressionMode) -> None:
    writer = Writer(folder, version=9, storage_plugin=storage)
    writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        topic = writer.add_connection('/a', STRING, typestore=STORE)
        for number in range(COUNT):
            message = string('', f'{number} {"x" * 1000}', number * MS)
            writer.write(topic, message.log_ns, message.data)


def _texts(reader: Any) -> list[str]:
    return [STORE.deserialize_cdr(each.data, STRING).data for each in reader.messages()]


@both_storages
@pytest.mark.parametrize('mode', [CompressionMode.FILE, CompressionMode.MESSAGE])
def test_messages(tmp_path: Path, storage: Any, mode: CompressionMode) -> None:
    """Whole files and single messages are decompressed, and nothing is left beside the bag."""
    folder = tmp_path / 'bag'
    _write(folder, storage, mode)
    before = sorted(folder.iterdir())
    reader = BagReader(str(folder))
    reader.check()
    assert [each.split()[0] for each in _texts(reader)] == [f'{n}' for n in range(COUNT)]
    (last,) = reader.messages(start_ns=START_NS + (COUNT - 1) * MS)
    assert last.log_ns == START_NS + (COUNT - 1) * MS
    assert Bags([str(folder)]).definition(STRING).text.strip().endswith('string data')
    assert sorted(folder.iterdir()) == before


@both_storages
def test_a_damaged_file(tmp_path: Path, storage: Any) -> None:
    """What is not compressed, or broken off, is told with its path."""
    folder = tmp_path / 'bag'
    _write(folder, storage, CompressionMode.FILE)
    (path,) = folder.glob('*.zstd')
    content = path.read_bytes()
    path.write_bytes(content[:50] + bytes(50) + content[100:])
    with pytest.raises(BrokenFile, match=path.name):
        _texts(BagReader(str(folder)))
    path.write_bytes(b'plain')
    with pytest.raises(BrokenFile, match='is not compressed with zstd, as metadata.yaml says'):
        BagReader(str(folder)).check()
    path.unlink()
    with pytest.raises(BagError, match='is missing'):
        BagReader(str(folder)).check()


def test_messages_that_are_not_compressed(tmp_path: Path) -> None:
    """Metadata that do not fit are told."""
    folder = tmp_path / 'bag'
    _write(folder, StoragePlugin.MCAP, CompressionMode.NONE)
    path = folder / 'metadata.yaml'
    text = path.read_text().replace("compression_mode: ''", 'compression_mode: MESSAGE')
    path.write_text(text.replace("compression_format: ''", 'compression_format: zstd'))
    with pytest.raises(BrokenFile, match="message on '/a' is not compressed with zstd"):
        _texts(BagReader(str(folder)))
