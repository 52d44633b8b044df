# SPDX-License-Identifier: Apache-2.0
"""Metadata of a recording, and their form in `metadata.yaml`, version 9."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
import os
from typing import Any

from ros2bag.storage import BagError
from ros2bag.storage.offered_qos import OfferedQos, qos_from_text
import yaml

__all__ = [
    'FILE_NAME',
    'VERSION',
    'BagMetadata',
    'FileInformation',
    'MessageSpan',
    'Topic',
    'TopicInformation',
    'merged',
    'metadata_from_text',
    'metadata_to_text',
]

VERSION = 9
NO_TIME_NS = 2**63 - 1
FILE_NAME = 'metadata.yaml'
ROOT = 'rosbag2_bagfile_information'


@dataclass(frozen=True)
class Topic:
    """A recorded topic."""

    name: str
    type_name: str
    type_hash: str = ''
    offered_qos: tuple[OfferedQos, ...] = ()
    serialization_format: str = 'cdr'

    @property
    def is_latched(self) -> bool:
        """Whether one of its publishers is latched (transient local)."""
        return any(qos.is_latched for qos in self.offered_qos)


@dataclass(frozen=True)
class TopicInformation:
    """A topic and its number of messages."""

    topic: Topic
    message_count: int


@dataclass(frozen=True)
class MessageSpan:
    """The number of messages, and their time span."""

    message_count: int = 0
    start_ns: int = NO_TIME_NS
    end_ns: int = 0

    @property
    def duration_ns(self) -> int:
        """Return the time from the first to the last message."""
        return max(0, self.end_ns - self.start_ns)

    def joined(self, other: MessageSpan) -> MessageSpan:
        """
        Return the union of two spans.

        Parameters
        ----------
        other
            The other span.

        """
        return MessageSpan(
            self.message_count + other.message_count,
            min(self.start_ns, other.start_ns),
            max(self.end_ns, other.end_ns),
        )


@dataclass(frozen=True)
class FileInformation:
    """One file of a recording."""

    path: str
    span: MessageSpan


@dataclass(frozen=True)
class BagMetadata:
    """Metadata of a whole recording."""

    files: tuple[FileInformation, ...]
    topics: tuple[TopicInformation, ...]
    ros_distro: str = ''
    storage_identifier: str = 'mcap'
    compression_format: str = ''
    compression_mode: str = ''
    custom_data: Mapping[str, str] = field(default_factory=dict)

    @property
    def span(self) -> MessageSpan:
        """Return the count and times of all messages."""
        whole = MessageSpan()
        for each in self.files:
            whole = whole.joined(each.span)
        return whole


def merged(parts: Iterable[BagMetadata]) -> BagMetadata:
    """
    Merge the metadata of files into those of their bag.

    Parameters
    ----------
    parts
        One per file, in their order; the last description of a topic counts.

    """
    parts = list(parts)
    topics: dict[str, TopicInformation] = {}
    for information in (each for part in parts for each in part.topics):
        name = information.topic.name
        before = topics[name].message_count if name in topics else 0
        topics[name] = TopicInformation(information.topic, before + information.message_count)
    return BagMetadata(
        files=tuple(file for part in parts for file in part.files),
        topics=tuple(topics[name] for name in sorted(topics)),
        ros_distro=next((part.ros_distro for part in parts if part.ros_distro), ''),
        storage_identifier=parts[0].storage_identifier if parts else 'mcap',
    )


def metadata_to_text(metadata: BagMetadata) -> str:
    """
    Serialize metadata to the content of `metadata.yaml`.

    Parameters
    ----------
    metadata
        The description of a bag.

    """
    span = metadata.span
    content = {
        'version': VERSION,
        'storage_identifier': metadata.storage_identifier,
        'duration': {'nanoseconds': span.duration_ns},
        'starting_time': {'nanoseconds_since_epoch': span.start_ns},
        'message_count': span.message_count,
        'topics_with_message_count': [_topic_to_dict(each) for each in metadata.topics],
        'compression_format': metadata.compression_format,
        'compression_mode': metadata.compression_mode,
        'relative_file_paths': [each.path for each in metadata.files],
        'files': [_file_to_dict(each) for each in metadata.files],
        'custom_data': dict(metadata.custom_data) or None,
        'ros_distro': metadata.ros_distro,
    }
    return yaml.dump({ROOT: content}, Dumper=_NoAliases, sort_keys=False)


def metadata_from_text(text: str, where: str) -> BagMetadata:
    """
    Parse the content of `metadata.yaml`.

    Parameters
    ----------
    text
        The content.
    where
        The path of the file, for error messages.

    Raises
    ------
    BagError
        The content is malformed, or of a version that is newer than 9.

    """
    try:
        content = yaml.safe_load(text)[ROOT]
        version = int(content['version'])
        metadata = _from_dict(content)
    except (yaml.YAMLError, KeyError, TypeError, ValueError, AttributeError) as error:
        reason = ' '.join(f'{type(error).__name__}: {error}'.split())
        raise BagError(
            f"'{where}' is not metadata of a recording ({reason}). Recreate it from the files: "
            f'ros2 bag recover {os.path.dirname(where) or "FOLDER"}'
        ) from error
    if version > VERSION:
        raise BagError(
            f"'{where}' has version {version}; only versions up to {VERSION} (ROS 2 Jazzy) are "
            'supported'
        )
    return metadata


class _NoAliases(yaml.SafeDumper):
    """YAML dumper that repeats shared values, because other readers do not support aliases."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _topic_to_dict(information: TopicInformation) -> dict[str, Any]:
    topic = information.topic
    return {
        'topic_metadata': {
            'name': topic.name,
            'type': topic.type_name,
            'serialization_format': topic.serialization_format,
            'offered_qos_profiles': [qos.to_dict() for qos in topic.offered_qos],
            'type_description_hash': topic.type_hash,
        },
        'message_count': information.message_count,
    }


def _file_to_dict(information: FileInformation) -> dict[str, Any]:
    return {
        'path': information.path,
        'starting_time': {'nanoseconds_since_epoch': information.span.start_ns},
        'duration': {'nanoseconds': information.span.duration_ns},
        'message_count': information.span.message_count,
    }


def _from_dict(content: dict[str, Any]) -> BagMetadata:
    return BagMetadata(
        files=_files(content),
        topics=tuple(_topic(each) for each in content['topics_with_message_count']),
        ros_distro=content.get('ros_distro') or '',
        storage_identifier=content['storage_identifier'],
        compression_format=content.get('compression_format') or '',
        compression_mode=(content.get('compression_mode') or '').lower(),
        custom_data=content.get('custom_data') or {},
    )


def _files(content: dict[str, Any]) -> tuple[FileInformation, ...]:
    """Return the files; before version 5 only their paths were listed."""
    if content.get('files'):
        return tuple(
            FileInformation(_text(each['path']), _span(each)) for each in content['files']
        )
    paths = [_text(each) for each in content['relative_file_paths']]
    spans = [_span(content), *(MessageSpan() for _ in paths[1:])]
    return tuple(FileInformation(path, span) for path, span in zip(paths, spans))


def _span(content: dict[str, Any]) -> MessageSpan:
    start_ns = _whole(content['starting_time']['nanoseconds_since_epoch'])
    count = _whole(content['message_count'])
    end_ns = start_ns + _whole(content['duration']['nanoseconds'])
    return MessageSpan(count, start_ns, end_ns) if count else MessageSpan()


def _topic(content: dict[str, Any]) -> TopicInformation:
    values = content['topic_metadata']
    topic = Topic(
        name=_text(values['name']),
        type_name=_text(values['type']),
        type_hash=_text(values.get('type_description_hash') or ''),
        offered_qos=qos_from_text(values.get('offered_qos_profiles') or []),
        serialization_format=_text(values['serialization_format']),
    )
    return TopicInformation(topic, _whole(content['message_count']))


def _text(value: Any) -> str:
    """Return a string, or raise TypeError."""
    if not isinstance(value, str):
        raise TypeError(f'{value!r} is not a string')
    return value


def _whole(value: Any) -> int:
    """Return an integer, or raise TypeError."""
    if not isinstance(value, int):
        raise TypeError(f'{value!r} is not an integer')
    return value
