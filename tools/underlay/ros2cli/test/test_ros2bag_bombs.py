# SPDX-License-Identifier: Apache-2.0
"""Recordings that would fill the memory."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import resource
from subprocess import CompletedProcess
import zlib

from bag_samples import write_bag
import lz4.frame
from mcap.records import Chunk
import pytest
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.damage import chunk_stream, ChunkTooLarge
from ros2bag.storage.recovery import recover
import zstandard

Ros2 = Callable[..., CompletedProcess[str]]

MEGA = 10**6
BOMB_BYTES = 2 * 10**9
BLOCK = bytes(MEGA)


def packed(compression: str, size: int, said: int = -1) -> bytes:
    """Return so many zeros, compressed a piece at a time; the frame need not say how many."""
    if compression == 'zstd':
        compressor = zstandard.ZstdCompressor(level=1).compressobj(size=said)
        parts = [compressor.compress(BLOCK) for _ in range(size // MEGA)]
        return b''.join([*parts, compressor.flush()])
    with lz4.frame.LZ4FrameCompressor() as compressor:
        parts = [compressor.begin(), *(compressor.compress(BLOCK) for _ in range(size // MEGA))]
        return b''.join([*parts, compressor.flush()])


def chunk(compression: str, data: bytes, size: int) -> Chunk:
    """Return a chunk that says that it has so many bytes."""
    return Chunk(compression, data, 1, 0, 0, size)


def peak_bytes() -> int:
    """Return the most memory that this process has had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


@pytest.mark.parametrize('compression', ['zstd', 'lz4'])
def test_what_recordings_have(compression: str) -> None:
    """Well compressed chunks of a common size are read, and large ones that are not so small."""
    stream, size = chunk_stream(chunk(compression, packed(compression, 3 * MEGA), 3 * MEGA))
    assert (stream.read(size), size) == (bytes(3 * MEGA), 3 * MEGA)
    assert chunk_stream(chunk('', b'abc', 3))[1] == 3


@pytest.mark.parametrize('compression', ['zstd', 'lz4'])
@pytest.mark.parametrize('said', [2**62, BOMB_BYTES, 70 * MEGA])
def test_what_says_that_it_is_large(compression: str, said: int) -> None:
    """A small chunk that says that it is very large is not unpacked."""
    with pytest.raises(ChunkTooLarge, match='a chunk of .* kB would take .* MB of memory'):
        chunk_stream(chunk(compression, b'small', said))


@pytest.mark.parametrize('compression', ['zstd', 'lz4'])
@pytest.mark.parametrize('said', [0, 5, 10 * MEGA])
def test_what_is_larger_than_it_says(compression: str, said: int) -> None:
    """A chunk gets room for what it says, and has to have just that."""
    data = packed(compression, 400 * MEGA)
    before = peak_bytes()
    with pytest.raises((ValueError, zstandard.ZstdError)):
        chunk_stream(chunk(compression, data, said))
    assert peak_bytes() - before < 100 * MEGA


def test_frame_that_says_that_it_is_large() -> None:
    """So has a frame whose own header asks for more."""
    data = packed('zstd', 300 * MEGA, 300 * MEGA)
    before = peak_bytes()
    with pytest.raises(ValueError, match='a frame of 300000000 bytes in a chunk of 5'):
        chunk_stream(chunk('zstd', data, 5))
    assert peak_bytes() - before < 100 * MEGA


def test_bag_with_a_bomb(tmp_path: Path, ros2: Ros2) -> None:
    """The rest of the recording is saved, and a sentence says what was left out."""
    folder = tmp_path / 'bag'
    write_bag(folder, 9)
    (path,) = folder.glob('*.mcap')
    whole = path.read_bytes()
    content = b''.join(
        (
            bytes(16),  # the first and the last time
            BOMB_BYTES.to_bytes(8, 'little'),
            zlib.crc32(b'x').to_bytes(4, 'little'),
            (4).to_bytes(4, 'little') + b'zstd',
        )
    )
    bomb = packed('zstd', BOMB_BYTES)
    content += len(bomb).to_bytes(8, 'little') + bomb
    record = b'\x06' + len(content).to_bytes(8, 'little') + content
    header = 8 + 9 + int.from_bytes(whole[9:17], 'little')  # behind the magic and the header
    path.write_bytes(whole[:header] + record + whole[header:])
    with pytest.raises(BagError):
        list(BagReader(str(folder)).messages())
    before = peak_bytes()
    (outcome,) = recover(str(folder))
    assert outcome.message_count == 10
    assert 'would take 2000 MB of memory' in outcome.objection
    assert peak_bytes() - before < 100 * MEGA
    assert len(list(BagReader(str(folder)).messages())) == 10
    path.write_bytes(whole[:header] + record + whole[header:])
    done = ros2('bag', 'recover', str(folder))
    assert 'skipped a chunk of' in done.stderr and 'recovered 10 messages' in done.stdout
