# SPDX-License-Identifier: Apache-2.0
"""The last messages of a recording, which are written only when asked for."""

from __future__ import annotations

from collections import deque
import math
import time
from typing import NamedTuple

from ros2bag.storage.bag_writer import BagWriter
from ros2bag.storage.latched import LatchedMessages, RecordedMessage
from ros2bag.storage.metadata import Topic

__all__ = ['Kept', 'MessageMemory', 'Snapshot']


class Kept(NamedTuple):
    """Snapshot of the buffered topics and messages."""

    topics: tuple[Topic, ...]
    messages: tuple[RecordedMessage, ...]


class MessageMemory:
    """
    Ring buffer of the latest messages, with the methods of `BagWriter` that a recorder calls.

    Latched messages that were dropped are still included at the start of a snapshot.

    Parameters
    ----------
    span_ns
        The duration for which messages are kept, in ns; may be infinite.
    max_bytes
        The maximum memory, in bytes, including the overhead.
    overhead_bytes
        An estimate of the memory per message, besides that of its data.

    Attributes
    ----------
    size_bytes
        The memory used, in bytes.

    """

    def __init__(self, span_ns: float, max_bytes: int, overhead_bytes: int = 300) -> None:
        self._span_ns = span_ns
        self._max_bytes = max_bytes
        self._overhead_bytes = overhead_bytes
        self._topics: dict[str, Topic] = {}
        self._messages: deque[RecordedMessage] = deque()
        self._latched = LatchedMessages()
        self.size_bytes = 0
        self.is_short = False
        """Whether messages had to be dropped early."""

    @property
    def message_count(self) -> int:
        """Return the number of buffered messages."""
        return len(self._messages)

    def age_ns(self, now_ns: int) -> int:
        """
        Return the age of the oldest message.

        Parameters
        ----------
        now_ns
            The current time, from `time.time_ns`.

        Returns
        -------
        int
            In ns; 0 if there is no message.

        """
        return now_ns - self._messages[0].log_ns if self._messages else 0

    def set_topic(self, topic: Topic) -> None:
        """
        Add a topic, or update the offered QoS of its publishers.

        Parameters
        ----------
        topic
            The topic; set before its first message is written.

        """
        self._topics[topic.name] = topic

    def write(self, message: RecordedMessage) -> None:
        """
        Store a message; the oldest messages are dropped if the memory limit is exceeded.

        Parameters
        ----------
        message
            A message of a topic that was set before.

        """
        self._messages.append(message)
        self.size_bytes += len(message.data) + self._overhead_bytes
        while self.size_bytes > self._max_bytes and self._messages:
            self.is_short = True
            self._forget_oldest()

    def forget_old(self, now_ns: int) -> None:
        """
        Drop the messages that are older than the time span.

        Parameters
        ----------
        now_ns
            The current time, from `time.time_ns`.

        """
        while self._messages and self._messages[0].log_ns < now_ns - self._span_ns:
            self._forget_oldest()
            self.is_short = False

    def kept(self, now_ns: int) -> Kept:
        """
        Take a snapshot of the messages, for a recording.

        Parameters
        ----------
        now_ns
            The current time, from `time.time_ns`.

        Returns
        -------
        Kept
            The topics and messages; dropped latched messages come first, with the start time.

        """
        self.forget_old(now_ns)
        start_ns = self._messages[0].log_ns if self._messages else now_ns
        head = (each.logged_at(start_ns) for each in self._latched.alive(start_ns))
        return Kept(tuple(self._topics.values()), (*head, *self._messages))

    def clear(self) -> None:
        """Drop all messages, but not the topics."""
        self._messages.clear()
        self._latched, self.size_bytes, self.is_short = LatchedMessages(), 0, False

    def _forget_oldest(self) -> None:
        message = self._messages.popleft()
        self.size_bytes -= len(message.data) + self._overhead_bytes
        topic = self._topics[message.topic]
        if topic.is_latched:
            self._latched.add(message, topic)


class Snapshot:
    """
    Buffer of the last messages, in the place of the writer of a bag.

    Parameters
    ----------
    writer
        The bag that snapshots are written to.
    max_bytes
        How much is kept; the oldest messages are dropped.

    """

    def __init__(self, writer: BagWriter, max_bytes: int) -> None:
        self._writer = writer
        self._memory = MessageMemory(math.inf, max_bytes, overhead_bytes=0)

    def set_topic(self, topic: Topic) -> None:
        """
        Register a topic, as for `BagWriter.set_topic`.

        Parameters
        ----------
        topic
            The topic.

        """
        self._memory.set_topic(topic)
        self._writer.set_topic(topic)

    def write(self, message: RecordedMessage) -> None:
        """
        Keep a message.

        Parameters
        ----------
        message
            The message, of a topic that is registered.

        """
        self._memory.write(message)

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
        messages = self._memory.kept(time.time_ns()).messages
        self._memory.clear()
        for message in messages:
            self._writer.write(message)
        return len(messages)
