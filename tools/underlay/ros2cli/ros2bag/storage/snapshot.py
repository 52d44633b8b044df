# SPDX-License-Identifier: Apache-2.0
"""The last messages of a recording in snapshot mode, which are written only when asked for."""

from __future__ import annotations

from collections import deque

from ros2bag.storage.bag_writer import BagWriter
from ros2bag.storage.latched import LatchedMessages, RecordedMessage
from ros2bag.storage.metadata import Topic

__all__ = ['Snapshot']


class Snapshot:
    """
    Buffer of the last messages, in the place of the writer of a bag.

    Of what no longer fits, it keeps the latched messages, so that a snapshot has them.

    Parameters
    ----------
    writer
        The bag that snapshots are written to.
    max_bytes
        How much is kept; the oldest messages are dropped.

    """

    def __init__(self, writer: BagWriter, max_bytes: int) -> None:
        self._writer, self._max_bytes = writer, max_bytes
        self._topics: dict[str, Topic] = {}
        self._kept: deque[RecordedMessage] = deque()
        self._latched = LatchedMessages()
        self._size = 0

    def set_topic(self, topic: Topic) -> None:
        """
        Register a topic, as for `BagWriter.set_topic`.

        Parameters
        ----------
        topic
            The topic.

        """
        self._topics[topic.name] = topic
        self._writer.set_topic(topic)

    def write(self, message: RecordedMessage) -> None:
        """
        Keep a message.

        Parameters
        ----------
        message
            The message, of a topic that is registered.

        """
        self._kept.append(message)
        self._size += len(message.data)
        while self._size > self._max_bytes:
            oldest = self._kept.popleft()
            self._size -= len(oldest.data)
            if self._topics[oldest.topic].is_latched:
                self._latched.add(oldest, self._topics[oldest.topic])

    def take(self) -> int:
        """
        Write all messages to the bag, and forget them.

        Returns
        -------
        int
            How many messages were written.

        Raises
        ------
        BagError
            The bag cannot be written.

        """
        start_ns = self._kept[0].log_ns if self._kept else 0
        latched = self._latched.alive(start_ns) if self._kept else ()
        messages = [*(each.logged_at(start_ns) for each in latched), *self._kept]
        self._kept.clear()
        self._latched, self._size = LatchedMessages(), 0
        for message in messages:
            self._writer.write(message)
        return len(messages)
