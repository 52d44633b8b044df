# SPDX-License-Identifier: Apache-2.0
"""Search for intact chunks of an MCAP file after damaged records."""

from __future__ import annotations

from collections.abc import Iterator
import re

from mcap.records import Chunk
from ros2bag.storage.bounded_chunks import chunk_stream
from ros2bag.storage.damage import BoundedFile, DAMAGE
from ros2bag.storage.mcap_record import read_record

__all__ = ['next_chunk', 'unpacked']

# Opcode; length below 2**40; first and last time, size, checksum; name of the compression.
CHUNK_START = re.compile(
    rb'\x06(?=.{5}\x00{3}.{28}(?:\x00{4}|\x03\x00{3}lz4|\x04\x00{3}zstd))', re.DOTALL
)
START_BYTES = 45
BLOCK_BYTES = 1024 * 1024


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
