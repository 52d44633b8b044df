# SPDX-License-Identifier: Apache-2.0
"""Options, filters and descriptions of bags, with the names and defaults of rosbag2."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from rclpy.duration import Duration
from rclpy.time import Time
from ros2bag.storage.metadata import BagMetadata as Description
from ros2bag.storage.metadata import FileInformation as FileDescription
from ros2bag.storage.metadata import Topic, VERSION

__all__ = [
    'BagMetadata',
    'ConverterOptions',
    'FileInformation',
    'ReadOrder',
    'ReadOrderSortBy',
    'StorageFilter',
    'StorageOptions',
    'TopicInformation',
    'TopicMetadata',
]


@dataclass
class ConverterOptions:
    """Formats of serialized messages: empty, or `cdr`, the only one."""

    input_serialization_format: str = ''
    output_serialization_format: str = ''


@dataclass
class StorageOptions:
    """
    Where a bag is, and how it is written.

    Parameters
    ----------
    uri
        The folder of the bag; for readers also one of its files.
    storage_id
        The format of its files: empty, or `mcap`, the only one.
    max_bagfile_size
        When to begin a new file, in bytes; 0 for no limit.
    max_bagfile_duration
        When to begin a new file, in s; 0 for no limit.
    max_cache_size
        No effect: messages are on the disk after 0.1 s.
    storage_preset_profile
        The compression: `none`, `fastwrite`, `zstd_fast` or `zstd_small`.
    storage_config_uri, snapshot_mode
        No effect.
    start_time_ns, end_time_ns
        The times between which messages are read, in ns since the epoch; -1 for no limit.
    custom_data
        Entries for the metadata.

    """

    uri: str = ''
    storage_id: str = ''
    max_bagfile_size: int = 0
    max_bagfile_duration: int = 0
    max_cache_size: int = 0
    storage_preset_profile: str = ''
    storage_config_uri: str = ''
    snapshot_mode: bool = False
    start_time_ns: int = -1
    end_time_ns: int = -1
    custom_data: dict[str, str] = field(default_factory=dict)


@dataclass
class StorageFilter:
    """
    Which topics are read; all, if nothing is given.

    Parameters
    ----------
    topics, exclude_topics
        Names of topics to read, and to leave out.
    services_events, exclude_service_events
        The same for topics with the events of services.
    regex, regex_to_exclude
        Regular expressions that whole names of topics have to match, or must not match.

    """

    topics: list[str] = field(default_factory=list)
    services_events: list[str] = field(default_factory=list)
    regex: str = ''
    exclude_topics: list[str] = field(default_factory=list)
    exclude_service_events: list[str] = field(default_factory=list)
    regex_to_exclude: str = ''


class ReadOrderSortBy:
    """By what messages are sorted: the time at which they were received."""

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


@dataclass
class ReadOrder:
    """
    The order of messages.

    Parameters
    ----------
    sort_by
        A value of `ReadOrderSortBy`.
    reverse
        Whether the last message comes first.

    """

    sort_by: int = ReadOrderSortBy.ReceivedTimestamp
    reverse: bool = False


@dataclass
class TopicMetadata:
    """
    Description of a topic.

    Parameters
    ----------
    id
        A number of the topic; not stored.
    name
        Its name.
    type
        The type of its messages, such as `std_msgs/msg/String`.
    serialization_format
        The format of serialized messages, `cdr`.
    offered_qos_profiles
        The quality of service of its publishers.
    type_description_hash
        The hash of the type.

    """

    id: int = 0
    name: str = ''
    type: str = ''
    serialization_format: str = 'cdr'
    offered_qos_profiles: list[Any] = field(default_factory=list)
    type_description_hash: str = ''

    def equals(self, other: TopicMetadata) -> bool:
        """
        Whether another description says the same about the same topic.

        Parameters
        ----------
        other
            The other description.

        """
        return self == other


@dataclass
class TopicInformation:
    """A topic and its number of messages."""

    topic_metadata: TopicMetadata = field(default_factory=TopicMetadata)
    message_count: int = 0


@dataclass
class FileInformation:
    """One file of a bag, with its time span and number of messages."""

    path: str = ''
    starting_time: Time = field(default_factory=Time)
    duration: Duration = field(default_factory=Duration)
    message_count: int = 0


@dataclass
class BagMetadata:
    """Metadata of a bag, as in its `metadata.yaml`; sizes in bytes."""

    version: int = VERSION
    bag_size: int = 0
    storage_identifier: str = ''
    relative_file_paths: list[str] = field(default_factory=list)
    files: list[FileInformation] = field(default_factory=list)
    duration: Duration = field(default_factory=Duration)
    starting_time: Time = field(default_factory=Time)
    message_count: int = 0
    topics_with_message_count: list[TopicInformation] = field(default_factory=list)
    compression_format: str = ''
    compression_mode: str = ''
    custom_data: dict[str, str] = field(default_factory=dict)
    ros_distro: str = ''


def topic_metadata(topic: Topic, number: int = 0) -> TopicMetadata:
    """
    Convert the description of a recorded topic.

    Parameters
    ----------
    topic
        The topic.
    number
        Its number.

    """
    return TopicMetadata(
        number,
        topic.name,
        topic.type_name,
        topic.serialization_format,
        list(topic.offered_qos),
        topic.type_hash,
    )


def bag_metadata(description: Description, size_bytes: int) -> BagMetadata:
    """
    Convert the metadata of a bag.

    Parameters
    ----------
    description
        The metadata.
    size_bytes
        The size of all files.

    """
    span = description.span
    return BagMetadata(
        bag_size=size_bytes,
        storage_identifier=description.storage_identifier,
        relative_file_paths=[file.path for file in description.files],
        files=[_file(file) for file in description.files],
        duration=Duration(nanoseconds=span.duration_ns),
        starting_time=Time(nanoseconds=span.start_ns),
        message_count=span.message_count,
        topics_with_message_count=[
            TopicInformation(topic_metadata(each.topic, number), each.message_count)
            for number, each in enumerate(description.topics)
        ],
        compression_format=description.compression_format,
        compression_mode=description.compression_mode,
        custom_data=dict(description.custom_data),
        ros_distro=description.ros_distro,
    )


def _file(file: FileDescription) -> FileInformation:
    return FileInformation(
        file.path,
        Time(nanoseconds=file.span.start_ns),
        Duration(nanoseconds=file.span.duration_ns),
        file.span.message_count,
    )
