# SPDX-License-Identifier: Apache-2.0
"""Writer of bags, message by message."""

from __future__ import annotations

from contextlib import suppress
import os
from typing import Any
import weakref

from ament_index_python.packages import get_package_share_directory
from ros2bag.storage import BagError
from ros2bag.storage.bag_writer import BagWriter, DEFAULT_DISTRO, WriterOptions
from ros2bag.storage.definitions import Definition, definition_of
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import Topic
from ros2bag.storage.offered_qos import OfferedQos
from ros2bag.storage.recovery import write_metadata
from rosbag2_py._formats import check_formats, get_registered_writers
from rosbag2_py._storage import ConverterOptions, StorageOptions, TopicMetadata

__all__ = ['Reindexer', 'SequentialWriter']

_COMPRESSIONS = {
    '': 'none',
    'none': 'none',
    'fastwrite': 'none',
    'zstd_fast': 'zstd',
    'zstd_small': 'zstd',
}
_SECOND_NS = 1_000_000_000


class SequentialWriter:
    """
    Writer of a bag: `open`, `create_topic` for each topic, then `write`.

    The bag is complete after `close`, or when the writer is deleted or the program ends.
    """

    def __init__(self) -> None:
        self._writer: BagWriter | None = None
        self._topics: set[str] = set()
        self._finish: Any = None

    def open(
        self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None
    ) -> None:
        """
        Create a bag.

        Parameters
        ----------
        storage_options
            Where, and when to begin new files.
        converter_options
            The formats of messages.

        Raises
        ------
        BagError
            The folder exists already, cannot be written, or an option is not supported.

        """
        check_formats(storage_options, converter_options, get_registered_writers())
        profile = storage_options.storage_preset_profile
        if profile not in _COMPRESSIONS:
            known = ', '.join(filter(None, _COMPRESSIONS))
            raise BagError(f"There is no storage preset profile '{profile}': choose from {known}")
        self.close()
        options = WriterOptions(
            compression=_COMPRESSIONS[profile],
            max_bytes=storage_options.max_bagfile_size,
            max_duration_ns=storage_options.max_bagfile_duration * _SECOND_NS,
            ros_distro=os.environ.get('ROS_DISTRO', DEFAULT_DISTRO),
            custom_data=dict(storage_options.custom_data),
        )
        self._writer = BagWriter(storage_options.uri, options, _find_definition)
        self._topics = set()
        self._finish = weakref.finalize(self, _close_quietly, self._writer)

    def close(self) -> None:
        """Complete the bag; nothing happens if none is open."""
        if self._writer is not None:
            self._finish.detach()
            writer, self._writer = self._writer, None
            writer.close()

    def create_topic(self, topic_with_type: TopicMetadata) -> None:
        """
        Add a topic; its first description counts.

        Parameters
        ----------
        topic_with_type
            Its name and type.

        """
        qos = tuple(
            each for each in topic_with_type.offered_qos_profiles if isinstance(each, OfferedQos)
        )
        self._opened().set_topic(
            Topic(
                topic_with_type.name,
                topic_with_type.type,
                topic_with_type.type_description_hash,
                qos,
                topic_with_type.serialization_format or 'cdr',
            )
        )
        self._topics.add(topic_with_type.name)

    def remove_topic(self, topic_with_type: TopicMetadata) -> None:
        """
        Take no further messages of a topic; those written before stay.

        Parameters
        ----------
        topic_with_type
            The topic.

        """
        self._topics.discard(topic_with_type.name)

    def write(self, topic_name: str, message: bytes, time_stamp: int) -> None:
        """
        Write a message.

        Parameters
        ----------
        topic_name
            A topic of `create_topic`.
        message
            The serialized message, such as from `rclpy.serialization.serialize_message`.
        time_stamp
            The time at which it was received, in ns since the epoch.

        Raises
        ------
        BagError
            The topic was not created, no bag is open, or the disk is full.

        """
        writer = self._opened()
        if topic_name not in self._topics:
            raise BagError(f"Call create_topic for '{topic_name}' before a message is written")
        writer.write(RecordedMessage(topic_name, bytes(message), time_stamp, time_stamp))
        writer.flush_if_due()

    def _opened(self) -> BagWriter:
        if self._writer is None:
            raise BagError('No bag is open: call open first')
        return self._writer


class Reindexer:
    """Restorer of `metadata.yaml` from the files of a bag."""

    def reindex(self, storage_options: StorageOptions) -> None:
        """
        Write the metadata of a bag anew.

        Parameters
        ----------
        storage_options
            Where the bag is.

        Raises
        ------
        BagError
            A file is damaged or still being written.

        """
        check_formats(storage_options, None, get_registered_writers())
        write_metadata(storage_options.uri)


def _find_definition(type_name: str) -> Definition:
    return definition_of(type_name, get_package_share_directory)


def _close_quietly(writer: BagWriter) -> None:
    with suppress(BagError):
        writer.close()
