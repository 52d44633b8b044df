# SPDX-License-Identifier: Apache-2.0
"""The messages of the last seconds."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import NamedTuple

from ros2bag.storage.bag_writer import BagWriter, WriterOptions
from ros2bag.storage.definitions import Definition
from ros2bag.storage.latched import LatchedMessages, RecordedMessage
from ros2bag.storage.metadata import Topic

__all__ = ['Kept', 'MessageMemory', 'write_bag']

OVERHEAD_BYTES = 300
"""About what a message costs besides its data."""


class Kept(NamedTuple):
    """What a recording of the last seconds is to have."""

    topics: tuple[Topic, ...]
    messages: tuple[RecordedMessage, ...]


class MessageMemory:
    """
    Takes messages as a writer of recordings does, but forgets those that are too old or too many.

    Latched messages that are forgotten still stand at the beginning of what is kept.
    """

    def __init__(self, span_ns: int, max_bytes: int) -> None:
        """Take how long messages are kept, and how many bytes of them at most."""
        self._span_ns = span_ns
        self._max_bytes = max_bytes
        self._topics: dict[str, Topic] = {}
        self._messages: deque[RecordedMessage] = deque()
        self._latched = LatchedMessages()
        self.size_bytes = 0
        self.is_short = False
        """Whether messages had to be forgotten early."""

    @property
    def message_count(self) -> int:
        """Return how many messages are kept."""
        return len(self._messages)

    def age_ns(self, now_ns: int) -> int:
        """Return how old the oldest message is."""
        return now_ns - self._messages[0].log_ns if self._messages else 0

    def set_topic(self, topic: Topic) -> None:
        """Make a topic known, or what its publishers offer now."""
        self._topics[topic.name] = topic

    def write(self, message: RecordedMessage) -> None:
        """Keep a message of a topic that is known."""
        self._messages.append(message)
        self.size_bytes += len(message.data) + OVERHEAD_BYTES
        while self.size_bytes > self._max_bytes and self._messages:
            self.is_short = True
            self._forget_oldest()

    def forget_old(self, now_ns: int) -> None:
        """Forget what is too old."""
        while self._messages and self._messages[0].log_ns < now_ns - self._span_ns:
            self._forget_oldest()
            self.is_short = False

    def kept(self, now_ns: int) -> Kept:
        """Return what a recording is to have now."""
        self.forget_old(now_ns)
        start_ns = self._messages[0].log_ns if self._messages else now_ns
        head = (each._replace(log_ns=start_ns) for each in self._latched.alive(now_ns))
        return Kept(tuple(self._topics.values()), (*head, *self._messages))

    def _forget_oldest(self) -> None:
        message = self._messages.popleft()
        self.size_bytes -= len(message.data) + OVERHEAD_BYTES
        topic = self._topics[message.topic]
        if topic.is_latched:
            self._latched.add(message, topic)


def write_bag(
    kept: Kept, folder: str, options: WriterOptions, find_definition: Callable[[str], Definition]
) -> int:
    """Write a recording, and return how many messages it has; BagError tells if it cannot be."""
    writer = BagWriter(folder, options, find_definition)
    try:
        for topic in kept.topics:
            writer.set_topic(topic)
        for message in kept.messages:
            writer.write(message)
    finally:
        writer.close()
    return writer.message_count
