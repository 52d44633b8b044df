# SPDX-License-Identifier: Apache-2.0
"""The messages that a late subscriber would still get, for the head of a new file."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import NamedTuple

__all__ = ['LatchedMessages', 'RecordedMessage']

# Of small messages more are kept than there are publishers, for example of /tf_static, where
# nobody knows which message replaces which.
KEPT_BYTES = 256 * 1024
KEPT_COUNT = 100


class RecordedMessage(NamedTuple):
    """A serialized message, when it arrived and when it was published."""

    topic: str
    data: bytes
    log_ns: int
    publish_ns: int
    sequence: int = 0


class LatchedMessages:
    """The last messages of each latched topic."""

    def __init__(self) -> None:
        """Start without any."""
        self._kept: dict[str, deque[RecordedMessage]] = {}

    def add(self, message: RecordedMessage, publishers: int) -> None:
        """Keep a message, and of the older ones at least one a publisher."""
        kept = self._kept.setdefault(message.topic, deque())
        kept.append(message)
        while len(kept) > max(1, publishers) and _is_much(kept):
            kept.popleft()

    def __iter__(self) -> Iterator[RecordedMessage]:
        """Yield the messages, of each topic the oldest first."""
        for kept in self._kept.values():
            yield from kept


def _is_much(kept: deque[RecordedMessage]) -> bool:
    return len(kept) > KEPT_COUNT or sum(len(each.data) for each in kept) > KEPT_BYTES
