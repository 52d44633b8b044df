# SPDX-License-Identifier: Apache-2.0
"""Salvage the readable records of a truncated or damaged MCAP file."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from io import BytesIO
import re
import struct
import sys
from typing import Any, IO, NamedTuple
import zlib

from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, Chunk, Header, Message, MessageIndex, Metadata, Schema
from ros2bag.storage import BagError
from ros2bag.storage.damage import BoundedFile, chunk_stream, DAMAGE, size_objection

__all__ = ['Content', 'Salvage']

MAGIC = b'\x89MCAP0\r\n'
CRC = struct.Struct('<I')
Content = Schema | Channel | Message
# Opcode; length below 2**40; first and last time, size, checksum; name of the compression.
CHUNK_START = re.compile(
    rb'\x06(?=.{5}\x00{3}.{28}(?:\x00{4}|\x03\x00{3}lz4|\x04\x00{3}zstd))', re.DOTALL
)
START_BYTES = 45
BLOCK_BYTES = 1024 * 1024
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


class Salvage:
    """
    Reader of the schemas, channels and messages of a broken MCAP file, in file order.

    Parameters
    ----------
    path
        The file, which is not opened before `records`.

    Attributes
    ----------
    compression
        The compression of the first whole chunk; '' if it has none.
    damaged_parts
        The number of skipped parts.
    is_sound
        Whether the data are intact, as far as there are checksums.
    objection
        Why a part was skipped that would have needed too much memory, or ''.

    """

    def __init__(self, path: str) -> None:
        self._path = path
        self._sum = 0
        # A message between chunks is another record with a damaged opcode.
        self._has_chunks = False
        self.compression = ''
        self.damaged_parts = 0
        self.is_sound = True
        self.objection = ''

    def records(self, progress: Callable[[float], None] = lambda share: None) -> Iterator[Content]:
        """
        Read all intact records; afterwards the attributes describe the outcome.

        Parameters
        ----------
        progress
            Called with the fraction (0 to 1) of the file that has been read.

        Yields
        ------
        Schema, Channel or Message
            The records.

        Raises
        ------
        BagError
            The file is not MCAP.

        """
        self.damaged_parts, self.is_sound = 0, True
        with BoundedFile(self._path) as stream:
            if not self._is_begun(stream):
                return
            while (record := read_record(stream)) is not None:
                yield from self._contents(record, stream)
                progress(stream.tell() / stream.size)

    def _is_begun(self, stream: BoundedFile) -> bool:
        """Whether the file has content; raise BagError if it is not a recording."""
        start = stream.read(len(MAGIC))
        self._sum = zlib.crc32(start)
        self.is_sound = start == MAGIC
        if MAGIC.startswith(start):
            return self.is_sound
        if next_chunk(stream, 0) is None:
            raise BagError(
                f"'{self._path}' is not an MCAP file: there is nothing to save. If the recording "
                'has other files, move this one out of the folder and try again'
            )
        stream.seek(len(MAGIC))
        return True

    def _contents(self, record: McapRecord, stream: BoundedFile) -> Iterator[Content]:
        """Yield the content of a record; after damage, continue at the next whole chunk."""
        if record.opcode == Opcode.DATA_END:
            self._verify_checksum(record.content)
        self._sum = zlib.crc32(RECORD_HEADER.pack(*record[:2]), self._sum)
        self._sum = zlib.crc32(record.content, self._sum)
        if record.opcode == Opcode.CHUNK:
            yield from self._chunk(record, stream)
            return
        value, used = record.parsed()
        if not record.is_plausible or used != record.length:
            start = stream.tell() - record.size
            self.damaged_parts += self._seek_next_chunk(stream, start)
        elif isinstance(value, Content) and not (self._has_chunks and isinstance(value, Message)):
            yield value

    def _chunk(self, record: McapRecord, stream: BoundedFile) -> Iterator[Content]:
        """Yield the content of a chunk, even of a truncated, uncompressed one at the end."""
        start = stream.tell() - record.size
        chunk, used = record.parsed()
        data = chunk and unpacked(chunk)
        if chunk and chunk.compression:
            self.objection = self.objection or size_objection(chunk)
        if data is not None:
            self.compression = self.compression or chunk.compression
            self._has_chunks = True
            yield from _contents_of(data)
            if used != record.length:
                self._seek_next_chunk(stream, start + RECORD_HEADER.size + used)
        elif self._seek_next_chunk(stream, start) or record.is_whole:
            self.damaged_parts += 1
        elif used == len(record.content) and chunk and not chunk.compression:
            yield from _contents_of(chunk.data)

    def _seek_next_chunk(self, stream: BoundedFile, position: int) -> bool:
        """Seek to the next whole chunk, or to the end; return whether there is one."""
        self.is_sound = False
        following = next_chunk(stream, position)
        stream.seek(stream.size if following is None else following)
        return following is not None

    def _verify_checksum(self, content: bytes) -> None:
        """Verify the checksum of the data; zero means no checksum."""
        expected = CRC.unpack(content)[0] if len(content) == CRC.size else 0
        self.is_sound = self.is_sound and expected in (0, self._sum)


def _contents_of(data: bytes) -> Iterator[Content]:
    """Yield the records of a chunk, up to a truncated one."""
    stream = BytesIO(data)
    while (record := read_record(stream)) is not None and record.is_whole:
        value = record.parsed()[0]
        if isinstance(value, Content):
            yield value


def next_chunk(stream: BoundedFile, position: int) -> int | None:
    """
    Find the next whole chunk with a correct checksum.

    Parameters
    ----------
    stream
        The file, whose position changes.
    position
        The offset in bytes at which to start.

    Returns
    -------
    int or None
        The offset of the record in bytes, or None if there is no such chunk.

    """
    return next((at for at in _candidates(stream, position) if _is_chunk(stream, at)), None)


def unpacked(chunk: Chunk) -> bytes | None:
    """
    Decompress and verify a chunk.

    Parameters
    ----------
    chunk
        The chunk as it is in the file.

    Returns
    -------
    bytes or None
        The records of the chunk; None if it is damaged or needs too much memory.

    """
    try:
        stream, size = chunk_stream(chunk, validate_crc=True)
        return stream.read(size)
    except DAMAGE:
        return None


def _candidates(stream: BoundedFile, position: int) -> Iterator[int]:
    """Yield the offsets of possible chunks."""
    while position < stream.size:
        stream.seek(position)
        block = stream.read(BLOCK_BYTES + START_BYTES)
        for match in CHUNK_START.finditer(block):
            if match.start() < BLOCK_BYTES:
                yield position + match.start()
        position += BLOCK_BYTES


def _is_chunk(stream: BoundedFile, position: int) -> bool:
    stream.seek(position)
    record = read_record(stream)
    if record is None or not record.is_whole:
        return False
    chunk = record.parsed()[0]
    return chunk is not None and chunk.uncompressed_crc != 0 and unpacked(chunk) is not None


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
