# SPDX-License-Identifier: Apache-2.0
"""
Reading of files that may be truncated, damaged, or made to do harm.

A few kilobytes of a compressed chunk can expand to gigabytes. The declared size of a chunk is
limited, absolutely and relative to its size in the file, and the decompressor may output no
more than that. The `mcap` library trusts the chunk; `limit_chunks` replaces its function.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import errno
import io
import os
import struct
import zlib

import lz4.frame
from mcap import stream_reader
from mcap.data_stream import ReadDataStream
from mcap.exceptions import InvalidMagic, McapError
from mcap.records import Chunk
from mcap.stream_reader import CRCValidationError
from ros2bag.storage import BagError
import yaml
import zstandard

__all__ = [
    'DAMAGE',
    'BoundedFile',
    'BrokenFile',
    'ChunkTooLarge',
    'chunk_stream',
    'damage_told',
    'limit_chunks',
    'size_objection',
]

MIB = 1024 * 1024
HARMLESS_BYTES = 64 * MIB
"""Size allowed for any compression ratio: a blank image compresses to almost nothing."""
LARGEST_BYTES = 1024 * MIB
LARGEST_RATIO = 100
# A flipped byte may affect a length, a channel ID, a string or a compression name.
DAMAGE = (
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    McapError,
    MemoryError,
    RuntimeError,
    StopIteration,
    TypeError,
    ValueError,
    zstandard.ZstdError,
    struct.error,
    yaml.YAMLError,
)
LARGE_BYTES = 1024 * 1024


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
    return ReadDataStream(io.BytesIO(data)), len(data)


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
        f'a chunk of {packed / 1000:.0f} kB would take {size / 10**6:.0f} MB of memory, which no '
        'recording does: it is damaged or malicious'
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
        raise ValueError(f'a chunk whose size is not the {size} bytes that it declares')
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


class BrokenFile(BagError):
    """A file is damaged, or has no index at its end because its recorder was killed."""


class BoundedFile(io.BufferedReader):
    """
    Binary file that never reads past its end, even for a damaged length.

    Parameters
    ----------
    path
        The file to open.

    Attributes
    ----------
    size
        The size of the file when it was opened, in bytes.

    """

    def __init__(self, path: str) -> None:
        super().__init__(io.FileIO(path))
        self.size = os.path.getsize(path)

    def read(self, size: int | None = -1, /) -> bytes:
        """
        Read bytes, at most as many as are left, so that a huge size allocates nothing.

        Parameters
        ----------
        size
            The number of bytes; all that are left if it is None or negative.

        """
        if size is not None and size > LARGE_BYTES:
            size = min(size, max(0, self.size - self.tell()))
        return super().read(size)


@contextmanager
def damage_told(path: str) -> Iterator[None]:
    """
    Translate the errors of reading an MCAP file, in a `with` statement, to a BagError.

    Parameters
    ----------
    path
        The file, for the message.

    Raises
    ------
    BagError
        The file is missing, unreadable or not MCAP.
    BrokenFile
        The file is truncated or damaged.

    """
    try:
        yield
    except BagError:
        raise
    except FileNotFoundError as error:
        raise BagError(
            f"the file '{path}' of the recording is missing. To continue without it: "
            f'ros2 bag reindex {os.path.dirname(path)}'
        ) from error
    except OSError as error:
        if error.errno != errno.EINVAL:
            raise BagError(f"'{path}' cannot be read: {error.strerror}") from error
        raise _broken(path, error) from error
    except ChunkTooLarge as error:
        raise BrokenFile(
            f"'{path}' is not read: {error}. Recover the rest with: "
            f'ros2 bag recover {os.path.dirname(path) or path}'
        ) from error
    except DAMAGE as error:
        if isinstance(error, InvalidMagic) and not path.endswith('.mcap'):
            raise BagError(f"'{path}' is not an MCAP file") from error
        raise _broken(path, error) from error


def _broken(path: str, error: BaseException) -> BrokenFile:
    return BrokenFile(
        f"'{path}' was not finished, or is damaged ({type(error).__name__}). "
        f'Recover its contents with: ros2 bag recover {os.path.dirname(path) or path}'
    )
