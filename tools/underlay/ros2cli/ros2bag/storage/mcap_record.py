# SPDX-License-Identifier: Apache-2.0
"""One record of an MCAP file, which may be truncated or damaged."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
import struct
import sys
from typing import Any, IO, NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, Header, Message, MessageIndex, Metadata, Schema
from ros2bag.storage.damage import DAMAGE

__all__ = ['RECORD_HEADER', 'McapRecord', 'read_record']

RECORD_HEADER = struct.Struct('<BQ')
# Opcodes from here on are private to programs; those in between are reserved.
PRIVATE_OPCODE = 0x80
PARSERS: dict[int, Callable[[ReadDataStream], Any]] = {
    Opcode.HEADER: Header.read,
    Opcode.SCHEMA: Schema.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.CHUNK: Chunk.read,
    Opcode.MESSAGE_INDEX: MessageIndex.read,
    Opcode.METADATA: Metadata.read,
}


class McapRecord(NamedTuple):
    """A record: its opcode, its declared length, and its possibly truncated content."""

    opcode: int
    length: int
    content: bytes

    @property
    def size(self) -> int:
        """Return the available size with the header, in bytes."""
        return RECORD_HEADER.size + len(self.content)

    @property
    def is_whole(self) -> bool:
        """Whether the content is complete."""
        return len(self.content) == self.length

    @property
    def is_plausible(self) -> bool:
        """Whether the content is complete and the opcode is known."""
        is_known = 0 < self.opcode <= max(Opcode) or self.opcode >= PRIVATE_OPCODE
        return is_known and self.is_whole

    def parsed(self) -> tuple[Any, int]:
        """
        Parse the content; return the object and the number of bytes that it takes.

        The object is None for a damaged record, with 0 bytes, and for kinds that are not needed,
        with all bytes.
        """
        stream = ReadDataStream(BytesIO(self.content))
        try:
            if self.opcode == Opcode.MESSAGE:
                return Message.read(stream, len(self.content)), len(self.content)
            if self.opcode in PARSERS:
                return PARSERS[self.opcode](stream), stream.count
        except DAMAGE:
            return None, 0
        return None, len(self.content)


def read_record(stream: IO[bytes]) -> McapRecord | None:
    """
    Read the next record of an MCAP file.

    Parameters
    ----------
    stream
        The file, or the decompressed data of a chunk, positioned at the start of a record.

    Returns
    -------
    McapRecord or None
        The record, whose content may be truncated; None if not even its header is left.

    """
    header = stream.read(RECORD_HEADER.size)
    if len(header) < RECORD_HEADER.size:
        return None
    opcode, length = RECORD_HEADER.unpack(header)
    return McapRecord(opcode, length, stream.read(min(length, sys.maxsize)))
