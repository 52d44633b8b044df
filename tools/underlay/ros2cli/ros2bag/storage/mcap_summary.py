# SPDX-License-Identifier: Apache-2.0
"""What the index at the end of an MCAP file says about it."""

from __future__ import annotations

import os
from typing import IO

from mcap.exceptions import McapError
from mcap.reader import SeekingReader
from mcap.records import Channel, Statistics
from mcap.summary import Summary
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

__all__ = ['BrokenFile', 'describe_file']

# What the reader of the library raises for files that are cut off or overwritten.
BROKEN = (McapError, EOFError, OSError, ValueError, KeyError, StopIteration, RuntimeError)


class BrokenFile(BagError):
    """A file has no index at its end, because its recorder was killed or it is damaged."""


def describe_file(path: str) -> BagMetadata:
    """Return the metadata of a recording that consists of this file; BrokenFile if it is cut."""
    try:
        with open(path, 'rb') as stream:
            return _describe(SeekingReader(stream), stream, os.path.basename(path))
    except FileNotFoundError as error:
        raise BagError(f"the file '{path}' of the recording is missing") from error
    except BROKEN as error:
        raise BrokenFile(
            f"'{path}' was not finished, or is damaged ({type(error).__name__}). "
            f'What it has can be saved: ros2 bag recover {os.path.dirname(path) or path}'
        ) from error


def _describe(reader: SeekingReader, stream: IO[bytes], name: str) -> BagMetadata:
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
    """Return the topic that a channel stands for."""
    return Topic(
        name=channel.topic,
        type_name=type_name,
        type_hash=channel.metadata.get('topic_type_hash', ''),
        offered_qos=qos_from_text(channel.metadata.get('offered_qos_profiles', '')),
        serialization_format=channel.message_encoding,
    )


def _distro(reader: SeekingReader) -> str:
    for record in reader.iter_metadata():
        if record.name == 'rosbag2' and 'serialized_metadata' in record.metadata:
            return metadata_from_text(
                record.metadata['serialized_metadata'], 'the file'
            ).ros_distro
    return ''
