# SPDX-License-Identifier: Apache-2.0
"""Latched messages, which a late subscriber would still get, for the start of a new file."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import NamedTuple

from ros2bag.storage.metadata import Topic

__all__ = ['LatchedMessages', 'RecordedMessage']

# More small messages are kept than there are publishers, for example of /tf_static, where it
# is unknown which message replaces which.
KEPT_BYTES = 256 * 1024
KEPT_COUNT = 100


class RecordedMessage(NamedTuple):
    """A serialized message with its reception and publication times."""

    topic: str
    data: bytes
    log_ns: int
    publish_ns: int
    sequence: int = 0

    def logged_at(self, log_ns: int) -> RecordedMessage:
        """
        Return the message with another reception time.

        Parameters
        ----------
        log_ns
            The reception time.

        """
        return self._replace(log_ns=log_ns)


class LatchedMessages:
    """The last messages of each latched topic."""

    def __init__(self) -> None:
        """Start without messages."""
        self._kept: dict[str, deque[RecordedMessage]] = {}
        self._lifespans_ns: dict[str, int] = {}

    def add(self, message: RecordedMessage, topic: Topic) -> None:
        """
        Store a message for late subscribers of its topic.

        Beyond 100 messages or 256 KiB the oldest ones of the topic are dropped, but as many as
        there are latched publishers stay.

        Parameters
        ----------
        message
            The message.
        topic
            Its topic, at least one of whose publishers offers transient-local durability.

        """
        offered = [qos for qos in topic.offered_qos if qos.is_latched]
        self._lifespans_ns[topic.name] = max(qos.lifespan_ns for qos in offered)
        kept = self._kept.setdefault(topic.name, deque())
        kept.append(message)
        while len(kept) > len(offered) and _is_much(kept):
            kept.popleft()

    def alive(self, now_ns: int) -> Iterator[RecordedMessage]:
        """
        Iterate over the messages whose lifespan has not expired.

        Parameters
        ----------
        now_ns
            The current time, in ns since the epoch.

        Yields
        ------
        RecordedMessage
            Topic by topic, the oldest first.

        """
        for topic, kept in self._kept.items():
            born_ns = now_ns - self._lifespans_ns[topic]
            yield from (message for message in kept if message.log_ns >= born_ns)


def _is_much(kept: deque[RecordedMessage]) -> bool:
    return len(kept) > KEPT_COUNT or sum(len(each.data) for each in kept) > KEPT_BYTES
