# SPDX-License-Identifier: Apache-2.0
"""Look through a file of a recording before anything is done with it."""

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
    The content of an MCAP file, read once from beginning to end, and whether the file is intact.

    Parameters
    ----------
    path
        The file.
    progress
        Called with the share (0 to 1) of the file that has been read.

    Attributes
    ----------
    schemas, channels
        By their numbers; of a number that is used twice the first meaning counts.
    message_count
        How many messages could be read.
    compression
        Of the chunks: `none`, `lz4` or `zstd`.
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
    """Return how many messages the index counts; -1 without an index."""
    try:
        return describe_file(path).span.message_count
    except BagError:
        return -1
