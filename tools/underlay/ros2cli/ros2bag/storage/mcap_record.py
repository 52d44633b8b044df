# SPDX-License-Identifier: Apache-2.0
"""One record of an MCAP file, which may be cut off or damaged."""

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
# From here on kinds belong to programs; those between are not given to anything yet.
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
    """Kind, the length that it should have, and the content as far as it is there."""

    opcode: int
    length: int
    content: bytes

    @property
    def size(self) -> int:
        """Return how many bytes there are with the header."""
        return RECORD_HEADER.size + len(self.content)

    @property
    def is_whole(self) -> bool:
        """Tell if nothing is missing at the end."""
        return len(self.content) == self.length

    @property
    def is_plausible(self) -> bool:
        """Tell if it is whole and of a kind that exists."""
        is_known = 0 < self.opcode <= max(Opcode) or self.opcode >= PRIVATE_OPCODE
        return is_known and self.is_whole

    def parsed(self) -> tuple[Any, int]:
        """
        Return what it stands for and how many bytes of the content that is.

        Of kinds that are not needed and of damaged ones it is None, as long as they are.
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
        The record, whose content may be cut off; None if not even its header is left.

    """
    header = stream.read(RECORD_HEADER.size)
    if len(header) < RECORD_HEADER.size:
        return None
    opcode, length = RECORD_HEADER.unpack(header)
    return McapRecord(opcode, length, stream.read(min(length, sys.maxsize)))
