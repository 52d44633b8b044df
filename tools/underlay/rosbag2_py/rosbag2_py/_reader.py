# SPDX-License-Identifier: Apache-2.0
"""Reader of bags, message by message."""

from __future__ import annotations

from collections.abc import Iterator
import re

from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.latched import RecordedMessage
from rosbag2_py._formats import check_formats, get_registered_readers
from rosbag2_py._storage import (
    bag_metadata,
    BagMetadata,
    ConverterOptions,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    topic_metadata,
    TopicMetadata,
)

__all__ = ['Info', 'SequentialReader']


class Info:
    """Reader of metadata alone."""

    def read_metadata(self, uri: str, storage_id: str = '') -> BagMetadata:
        """
        Read the metadata of a bag.

        Parameters
        ----------
        uri
            The folder of the bag, or one of its files.
        storage_id
            The format of its files.

        Raises
        ------
        BagError
            There is no bag, or its metadata are malformed.

        """
        check_formats(StorageOptions(uri, storage_id), None, get_registered_readers())
        reader = BagReader(uri)
        return bag_metadata(reader.metadata, reader.size_bytes)


class SequentialReader:
    """Reader of a bag: `open`, then `read_next` while `has_next`."""

    def __init__(self) -> None:
        self._reader: BagReader | None = None
        self._options = StorageOptions()
        self._filter = StorageFilter()
        self._messages: Iterator[RecordedMessage] = iter(())
        self._next: RecordedMessage | None = None
        self._last: RecordedMessage | None = None
        self._from_ns = 0

    def open(
        self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None
    ) -> None:
        """
        Open a bag at its first message.

        Parameters
        ----------
        storage_options
            Where the bag is.
        converter_options
            The formats of messages.

        Raises
        ------
        BagError
            There is no bag, it is damaged, or its format is not supported.

        """
        check_formats(storage_options, converter_options, get_registered_readers())
        reader = BagReader(storage_options.uri)
        reader.check()
        self._reader, self._options = reader, storage_options
        self._filter = StorageFilter()
        self._start(storage_options.start_time_ns)

    def open_uri(self, uri: str) -> None:
        """
        Open a bag with default options.

        Parameters
        ----------
        uri
            The folder of the bag, or one of its files.

        Raises
        ------
        BagError
            As for `open`.

        """
        self.open(StorageOptions(uri))

    def close(self) -> None:
        """Close the bag."""
        self._reader, self._messages, self._next = None, iter(()), None

    def has_next(self) -> bool:
        """
        Whether there is another message.

        Raises
        ------
        BagError
            No bag is open, or its file is damaged.

        """
        self._opened()
        if self._next is None:
            self._next = next(self._messages, None)
        if self._next is not None and 0 <= self._options.end_time_ns < self._next.log_ns:
            self._next, self._messages = None, iter(())
        return self._next is not None

    def read_next(self) -> tuple[str, bytes, int]:
        """
        Read the next message.

        Returns
        -------
        tuple
            The topic, the serialized message, and the time at which it was received, in ns.

        Raises
        ------
        BagError
            There is no further message, no bag is open, or its file is damaged.

        """
        if not self.has_next() or self._next is None:
            raise BagError('The bag has no further message: ask has_next before read_next')
        message, self._last, self._next = self._next, self._next, None
        return message.topic, message.data, message.log_ns

    def get_metadata(self) -> BagMetadata:
        """Return the metadata of the bag."""
        reader = self._opened()
        return bag_metadata(reader.metadata, reader.size_bytes)

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """Return descriptions of all topics of the bag."""
        topics = self._opened().metadata.topics
        return [topic_metadata(each.topic, number) for number, each in enumerate(topics)]

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """
        Read only some topics, from the next message on.

        Parameters
        ----------
        storage_filter
            The topics.

        """
        self._opened()
        self._filter = storage_filter
        if self._last is None:
            self._start(self._from_ns)
        else:
            self._messages, self._next = self._after(self._last), None

    def reset_filter(self) -> None:
        """Read all topics again, from the next message on."""
        self.set_filter(StorageFilter())

    def seek(self, timestamp: int) -> None:
        """
        Go to the first message that was received at a time or later.

        Parameters
        ----------
        timestamp
            The time in ns since the epoch.

        """
        self._start(timestamp)

    def set_read_order(self, read_order: ReadOrder) -> bool:
        """
        Choose the order of messages, of which only one is supported.

        Parameters
        ----------
        read_order
            The order.

        Returns
        -------
        bool
            Whether messages are read in that order.

        """
        return read_order.sort_by != ReadOrderSortBy.PublishedTimestamp and not read_order.reverse

    def _opened(self) -> BagReader:
        if self._reader is None:
            raise BagError('No bag is open: call open first')
        return self._reader

    def _start(self, start_ns: int) -> None:
        """Begin with the first message of the filter that was received at a time or later."""
        self._from_ns, self._last = max(0, start_ns), None
        self._messages = self._opened().messages(self._selected(), self._from_ns)
        self._next = None

    def _after(self, last: RecordedMessage) -> Iterator[RecordedMessage]:
        """Read the messages of the filter that follow one that was read."""
        topics = self._selected()
        messages = self._opened().messages(None, last.log_ns)
        for message in messages:
            if message == last:
                break
        yield from (each for each in messages if topics is None or each.topic in topics)

    def _selected(self) -> list[str] | None:
        """Return the topics of the filter; None for all."""
        chosen = self._filter
        names = [each.topic.name for each in self._opened().metadata.topics]
        if chosen == StorageFilter():
            return None
        wanted = {*chosen.topics, *chosen.services_events}
        left_out = {*chosen.exclude_topics, *chosen.exclude_service_events}
        return [
            name
            for name in names
            if (name in wanted or _matches(chosen.regex, name) or not (wanted or chosen.regex))
            and name not in left_out
            and not _matches(chosen.regex_to_exclude, name)
        ]


def _matches(regex: str, name: str) -> bool:
    return bool(regex) and re.fullmatch(regex, name) is not None
