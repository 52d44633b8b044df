# SPDX-License-Identifier: Apache-2.0
"""Salvage the readable records of a truncated or damaged MCAP file."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from io import BytesIO
import struct
import zlib

from mcap.opcode import Opcode
from mcap.records import Channel, Message, Schema
from ros2bag.storage.bounded_chunks import size_objection
from ros2bag.storage.chunk_search import next_chunk, unpacked
from ros2bag.storage.damage import BoundedFile
from ros2bag.storage.errors import BagError
from ros2bag.storage.mcap_record import McapRecord, read_record, RECORD_HEADER

__all__ = ['Content', 'Salvage']

MAGIC = b'\x89MCAP0\r\n'
CRC = struct.Struct('<I')
Content = Schema | Channel | Message


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
            self._compare_sums(record.content)
        self._sum = zlib.crc32(RECORD_HEADER.pack(*record[:2]), self._sum)
        self._sum = zlib.crc32(record.content, self._sum)
        if record.opcode == Opcode.CHUNK:
            yield from self._chunk(record, stream)
            return
        value, used = record.parsed()
        if not record.is_plausible or used != record.length:
            start = stream.tell() - record.size
            self.damaged_parts += self._go_on_behind(stream, start)
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
                self._go_on_behind(stream, start + RECORD_HEADER.size + used)
        elif self._go_on_behind(stream, start) or record.is_whole:
            self.damaged_parts += 1
        elif used == len(record.content) and chunk and not chunk.compression:
            yield from _contents_of(chunk.data)

    def _go_on_behind(self, stream: BoundedFile, position: int) -> bool:
        """Seek to the next whole chunk, or to the end; return whether there is one."""
        self.is_sound = False
        following = next_chunk(stream, position)
        stream.seek(stream.size if following is None else following)
        return following is not None

    def _compare_sums(self, content: bytes) -> None:
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
