# SPDX-License-Identifier: Apache-2.0
"""Survey of a file of a recording before it is recovered."""

from __future__ import annotations

from collections.abc import Callable

from mcap.records import Channel, Message, Schema
from ros2bag.storage.damage import damage_told
from ros2bag.storage.errors import BagError
from ros2bag.storage.mcap_summary import describe_file
from ros2bag.storage.salvage import Content, Salvage

__all__ = ['Survey']


class Survey:
    """
    Content summary of an MCAP file, read once from start to end, and whether it is intact.

    Parameters
    ----------
    path
        The file.
    progress
        Called with the fraction (0 to 1) of the file that has been read.

    Attributes
    ----------
    schemas, channels
        By their IDs; the first record with an ID counts.
    message_count
        The number of readable messages.
    compression
        The compression of the chunks: `none`, `lz4` or `zstd`.
    damaged_parts, objection
        As in `Salvage`.
    is_whole
        Whether nothing is damaged, and the index counts the same messages.

    Raises
    ------
    BagError
        The file is missing, unreadable or not MCAP.

    """

    def __init__(self, path: str, progress: Callable[[float], None]) -> None:
        self.schemas: dict[int, Schema] = {}
        self.channels: dict[int, Channel] = {}
        self.message_count = 0
        salvage = Salvage(path)
        with damage_told(path):
            for record in salvage.records(progress):
                self._note(record)
        self.compression = salvage.compression or 'none'
        self.damaged_parts = salvage.damaged_parts
        self.objection = salvage.objection
        self.is_whole = salvage.is_sound and self.message_count == _counted(path)

    def _note(self, record: Content) -> None:
        if isinstance(record, Message):
            self.message_count += 1
        elif isinstance(record, Schema):
            self.schemas.setdefault(record.id, record)
        else:
            self.channels.setdefault(record.id, record)


def _counted(path: str) -> int:
    """Return the message count of the index; -1 without an index."""
    try:
        return describe_file(path).span.message_count
    except BagError:
        return -1
