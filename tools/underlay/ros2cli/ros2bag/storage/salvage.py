# SPDX-License-Identifier: Apache-2.0
"""Read what can be read of an MCAP file that is cut off or damaged."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from io import BytesIO
import os
import struct
from typing import IO

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, Message, Schema
from mcap.stream_reader import get_chunk_data_stream
from ros2bag.storage.errors import BagError
from zstandard import ZstdError

__all__ = ['Salvage']

MAGIC = b'\x89MCAP0\r\n'
RECORD_HEADER = struct.Struct('<BQ')
# A disk that lost its power may have a tail of zeros.
ENDS = (0, Opcode.DATA_END, Opcode.FOOTER)
DAMAGED = (McapError, RuntimeError, ValueError, struct.error, ZstdError)


class Salvage:
    """The schemas, channels and messages of a broken file, in the order of the file."""

    def __init__(self, path: str) -> None:
        """Start without having read anything."""
        self._path = path
        self.damaged_chunks = 0
        self.compression = ''

    def records(
        self, progress: Callable[[float], None] = lambda share: None
    ) -> Iterator[Schema | Channel | Message]:
        """Yield the records; `progress` is told which share of the file has been read."""
        size = os.path.getsize(self._path)
        with open(self._path, 'rb') as stream:
            if stream.read(len(MAGIC)) != MAGIC:
                raise BagError(f"'{self._path}' is not an MCAP file: there is nothing to save")
            for opcode, content, is_whole in _records(stream, size):
                if opcode == Opcode.CHUNK:
                    yield from self._in_chunk(content, is_whole)
                elif is_whole:
                    yield from _parsed(opcode, content)
                progress(stream.tell() / size)

    def _in_chunk(self, content: bytes, is_whole: bool) -> Iterator[Schema | Channel | Message]:
        """Yield what a chunk has; of one that is cut off, if it is not compressed, the start."""
        try:
            chunk = Chunk.read(ReadDataStream(BytesIO(content)))
            data = chunk.data if not is_whole and not chunk.compression else _unpacked(chunk)
        except DAMAGED:
            self.damaged_chunks += is_whole
            return
        self.compression = chunk.compression
        for opcode, inner, inner_is_whole in _records(BytesIO(data), len(data)):
            if inner_is_whole:
                yield from _parsed(opcode, inner)


def _records(stream: IO[bytes], size: int) -> Iterator[tuple[int, bytes, bool]]:
    """Yield kind and content of the records, up to the end of the data; the last may be cut."""
    while True:
        header = stream.read(RECORD_HEADER.size)
        if len(header) < RECORD_HEADER.size:
            return
        opcode, length = RECORD_HEADER.unpack(header)
        if opcode in ENDS:
            return
        content = stream.read(min(length, size))
        yield opcode, content, len(content) == length


def _unpacked(chunk: Chunk) -> bytes:
    stream, size = get_chunk_data_stream(chunk, validate_crc=True)
    return stream.read(size)


def _parsed(opcode: int, content: bytes) -> Iterator[Schema | Channel | Message]:
    """Yield the record, unless it is damaged or of a kind that is made anew anyway."""
    stream = ReadDataStream(BytesIO(content))
    try:
        if opcode == Opcode.SCHEMA:
            yield Schema.read(stream)
        elif opcode == Opcode.CHANNEL:
            yield Channel.read(stream)
        elif opcode == Opcode.MESSAGE:
            yield Message.read(stream, len(content))
    except DAMAGED:
        return
