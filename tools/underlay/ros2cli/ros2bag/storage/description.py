# SPDX-License-Identifier: Apache-2.0
"""Describe a recording: by its `metadata.yaml`, or a single file by its index or its tables."""

from __future__ import annotations

from contextlib import suppress
import os
import struct
from typing import TYPE_CHECKING
import zlib

from ros2bag.storage import BagError
from ros2bag.storage.metadata import (
    BagMetadata,
    FILE_NAME,
    FileInformation,
    MessageSpan,
    metadata_from_text,
    Topic,
    TopicInformation,
)
from ros2bag.storage.offered_qos import qos_from_text

if TYPE_CHECKING:
    # Imported by the functions that read a file: the metadata of a folder need none of it.
    from mcap.reader import SeekingReader
    from mcap.records import Channel, Statistics
    from mcap.summary import Summary
    from ros2bag.storage.damage import BoundedFile
    from ros2bag.storage.sqlite_file import SqliteFile

__all__ = ['database_of', 'describe_file', 'read_metadata', 'topic_of']

FOOTER = struct.Struct('<BQQQI')
MAGIC_BYTES = 8
CRC_BYTES = 4


def read_metadata(folder: str) -> BagMetadata:
    """
    Read `metadata.yaml` of a recording.

    Parameters
    ----------
    folder
        The folder of the recording.

    Raises
    ------
    BagError
        It does not exist, cannot be read, or is malformed.

    """
    path = os.path.join(folder, FILE_NAME)
    try:
        with open(path, encoding='utf-8') as stream:
            return metadata_from_text(stream.read(), path)
    except FileNotFoundError as error:
        raise BagError(_no_metadata_text(folder)) from error
    except (OSError, UnicodeDecodeError) as error:
        raise BagError(f"'{path}' cannot be read: {error}") from error


def _no_metadata_text(folder: str) -> str:
    names = os.listdir(folder)
    if any(name.endswith('.db3') for name in names):
        return f"'{folder}' has no {FILE_NAME}. Recreate it with: ros2 bag reindex {folder}"
    if any(name.endswith('.mcap') for name in names):
        return (
            f"'{folder}' has no {FILE_NAME}: its recording is still running or was not finished. "
            f'Recover its contents with: ros2 bag recover {folder}'
        )
    return f"'{folder}' is not the folder of a recording: it has no {FILE_NAME}"


def describe_file(path: str) -> BagMetadata:
    """
    Read the metadata of a single file: of MCAP from its index, of SQLite from its tables.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    BagMetadata
        The metadata of a bag that consists of this file.

    Raises
    ------
    BagError
        The file is missing, unreadable or not a recording.
    BrokenFile
        The file has no index, or is damaged.

    """
    if (database := database_of(path)) is not None:
        return database.describe()
    from mcap.reader import SeekingReader
    from ros2bag.storage.damage import BoundedFile, damage_told

    with damage_told(path), BoundedFile(path) as stream:
        reader = SeekingReader(stream)
        _check_sum(stream)
        return _describe(reader, os.path.basename(path))


def _check_sum(stream: BoundedFile) -> None:
    """Raise ValueError if the checksum of the index does not match; zero means no checksum."""
    stream.seek(-FOOTER.size - MAGIC_BYTES, os.SEEK_END)
    footer = stream.read(FOOTER.size)
    _, _, start, _, expected = FOOTER.unpack(footer)
    if not start or not expected:
        return
    stream.seek(start)
    length = stream.size - MAGIC_BYTES - CRC_BYTES - start
    if zlib.crc32(stream.read(length)) != expected:
        raise ValueError('the index is damaged')


def _describe(reader: SeekingReader, name: str) -> BagMetadata:
    summary = reader.get_summary()
    if summary is None or summary.statistics is None:
        raise EOFError
    statistics = summary.statistics
    span = MessageSpan(
        statistics.message_count, statistics.message_start_time, statistics.message_end_time
    )
    return BagMetadata(
        files=(FileInformation(name, span if span.message_count else MessageSpan()),),
        topics=_topics(summary, statistics),
        ros_distro=_distro(reader),
    )


def _topics(summary: Summary, statistics: Statistics) -> tuple[TopicInformation, ...]:
    return tuple(
        TopicInformation(
            topic_of(channel, summary.schemas[channel.schema_id].name),
            statistics.channel_message_counts.get(channel.id, 0),
        )
        for channel in sorted(summary.channels.values(), key=lambda channel: channel.topic)
        if channel.schema_id in summary.schemas
    )


def topic_of(channel: Channel, type_name: str) -> Topic:
    """
    Convert an MCAP channel to the topic that was recorded in it.

    Parameters
    ----------
    channel
        The channel, with the offered QoS and the type hash in its metadata.
    type_name
        The name of the channel's schema.

    """
    return Topic(
        name=channel.topic,
        type_name=type_name,
        type_hash=channel.metadata.get('topic_type_hash', ''),
        offered_qos=qos_from_text(channel.metadata.get('offered_qos_profiles', '')),
        serialization_format=channel.message_encoding,
    )


def _distro(reader: SeekingReader) -> str:
    for record in reader.iter_metadata():
        with suppress(BagError):
            if record.name == 'rosbag2':
                text = record.metadata.get('serialized_metadata', '')
                return metadata_from_text(text, 'the file').ros_distro
    return ''


def database_of(path: str) -> SqliteFile | None:
    """
    Return a file in SQLite; None for other files.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    BagError
        It seems to be one, but this Python cannot read it.

    """
    try:
        from ros2bag.storage.sqlite_file import is_sqlite, SqliteFile
    except ImportError as error:
        if not path.endswith('.db3'):
            return None
        raise BagError(f"'{path}' cannot be read: this Python has no module sqlite3") from error
    return SqliteFile(path) if is_sqlite(path) else None
