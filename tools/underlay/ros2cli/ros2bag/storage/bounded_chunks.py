# SPDX-License-Identifier: Apache-2.0
"""
Decompression of MCAP chunks within a memory limit.

A few kilobytes of a compressed chunk can expand to gigabytes. The declared size of a chunk is
limited, absolutely and relative to its size in the file, and the decompressor may output no
more than that. The `mcap` library trusts the chunk; `limit_chunks` replaces its function.
"""

from __future__ import annotations

from io import BytesIO
import zlib

import lz4.frame
from mcap import stream_reader
from mcap.data_stream import ReadDataStream
from mcap.records import Chunk
from mcap.stream_reader import CRCValidationError
import zstandard

__all__ = ['ChunkTooLarge', 'chunk_stream', 'limit_chunks', 'size_objection']

MIB = 1024 * 1024
HARMLESS_BYTES = 64 * MIB
"""Size allowed for any compression ratio: a blank image compresses to almost nothing."""
LARGEST_BYTES = 1024 * MIB
LARGEST_RATIO = 100


class ChunkTooLarge(ValueError):
    """The chunk would need more memory than any recording does."""


def chunk_stream(chunk: Chunk, validate_crc: bool = False) -> tuple[ReadDataStream, int]:
    """
    Decompress a chunk within a memory limit.

    Parameters
    ----------
    chunk
        The chunk as it is in the file.
    validate_crc
        Whether to compare the data with the checksum of the chunk, if it has one.

    Returns
    -------
    tuple of ReadDataStream and int
        The records of the chunk as a stream, and their length in bytes.

    Raises
    ------
    ChunkTooLarge
        The declared size of the chunk is too large.
    ValueError
        The size of the chunk differs from the declared one.
    CRCValidationError
        The checksum does not match.

    """
    data = _unpacked(chunk)
    if validate_crc and chunk.uncompressed_crc != 0:
        actual = zlib.crc32(data)
        if actual != chunk.uncompressed_crc:
            raise CRCValidationError(chunk.uncompressed_crc, actual, chunk)
    return ReadDataStream(BytesIO(data)), len(data)


def size_objection(chunk: Chunk) -> str:
    """
    Check the declared size of a chunk against the limits.

    Parameters
    ----------
    chunk
        The chunk as it is in the file.

    Returns
    -------
    str
        Why the chunk is not decompressed, or ''.

    """
    size, packed = chunk.uncompressed_size, len(chunk.data)
    if size <= min(LARGEST_BYTES, max(HARMLESS_BYTES, LARGEST_RATIO * packed)):
        return ''
    return (
        f'a chunk of {packed / 1000:.0f} kB would take {size / 10**6:.0f} MB of memory, as no '
        'recording does: it is damaged, or made to do harm'
    )


def limit_chunks() -> None:
    """Make all readers of the `mcap` library decompress chunks within the limits."""
    stream_reader.get_chunk_data_stream = chunk_stream


def _unpacked(chunk: Chunk) -> bytes:
    if chunk.compression not in ('zstd', 'lz4'):
        return chunk.data
    size = chunk.uncompressed_size
    objection = size_objection(chunk)
    if objection:
        raise ChunkTooLarge(objection)
    unpack = _unpack_zstd if chunk.compression == 'zstd' else _unpack_lz4
    data = unpack(chunk.data, size)
    if len(data) != size:
        raise ValueError(f'a chunk with other than the {size} bytes that it says')
    return data


def _unpack_zstd(packed: bytes, size: int) -> bytes:
    """Decompress at most the given size; reject a frame that declares more."""
    said = zstandard.frame_content_size(packed)
    if said > size:
        raise ValueError(f'a frame of {said} bytes in a chunk of {size}')
    return zstandard.ZstdDecompressor().decompress(packed, max_output_size=max(size, 1))


def _unpack_lz4(packed: bytes, size: int) -> bytes:
    """Decompress at most one byte more than the given size."""
    with lz4.frame.LZ4FrameDecompressor() as decompressor:
        unpacked: bytes = decompressor.decompress(packed, max_length=size + 1)
    return unpacked
