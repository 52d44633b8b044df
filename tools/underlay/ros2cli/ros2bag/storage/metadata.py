# SPDX-License-Identifier: Apache-2.0
"""Metadata of a recording, as in `metadata.yaml`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ros2bag.storage.offered_qos import OfferedQos

__all__ = [
    'VERSION',
    'BagMetadata',
    'FileInformation',
    'MessageSpan',
    'Topic',
    'TopicInformation',
]

VERSION = 9
NO_TIME_NS = 2**63 - 1


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
