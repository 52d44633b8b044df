# SPDX-License-Identifier: Apache-2.0
"""Metadata from the index at the end of an MCAP file."""

from __future__ import annotations

from contextlib import suppress
import os
import struct
import zlib

from mcap.reader import SeekingReader
from mcap.records import Channel, Statistics
from mcap.summary import Summary
from ros2bag.storage.damage import BoundedFile, damage_told
from ros2bag.storage.errors import BagError
from ros2bag.storage.metadata import (
    BagMetadata,
    FileInformation,
    MessageSpan,
    Topic,
    TopicInformation,
)
from ros2bag.storage.metadata_yaml import metadata_from_text
from ros2bag.storage.offered_qos import qos_from_text

__all__ = ['describe_file', 'topic_of']

FOOTER = struct.Struct('<BQQQI')
MAGIC_BYTES = 8
CRC_BYTES = 4


def describe_file(path: str) -> BagMetadata:
    """
    Read the metadata of a single MCAP file from its index.

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
        The file is missing, unreadable or not MCAP.
    BrokenFile
        The file has no index, or is damaged.

    """
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
