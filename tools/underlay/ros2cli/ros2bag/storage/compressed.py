# SPDX-License-Identifier: Apache-2.0
"""Read what a recorder has compressed with zstd: whole files, or the data of each message."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import os
import shutil
from tempfile import TemporaryDirectory

from ros2bag.storage.damage import BrokenFile
from ros2bag.storage.latched import RecordedMessage
import zstandard

__all__ = ['FORMAT', 'check_magic', 'decompressed', 'with_plain_data']

FORMAT = 'zstd'
LARGEST_BYTES = 2**30
"""Of a message, whose header says its size: memory is taken for it before it is read."""
MAGIC = zstandard.FRAME_HEADER


def check_magic(path: str) -> None:
    """
    Check that a file begins as a compressed one does.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    OSError
        The file cannot be read.
    BrokenFile
        It begins otherwise.

    """
    with open(path, 'rb') as stream:
        if stream.read(len(MAGIC)) != MAGIC:
            raise BrokenFile(f"'{path}' is not compressed with {FORMAT}, as metadata.yaml says")


@contextmanager
def decompressed(path: str) -> Iterator[str]:
    """
    Decompress a file to a temporary one, for the length of a `with` block.

    Parameters
    ----------
    path
        The file, whose name ends with `.zstd`.

    Yields
    ------
    str
        The path of the temporary file, which has the rest of the name.

    Raises
    ------
    OSError
        The file cannot be read, or the temporary one cannot be written.
    BrokenFile
        The file is damaged.

    """
    check_magic(path)
    with TemporaryDirectory(prefix='rosbag2_') as folder:
        plain = os.path.join(folder, os.path.basename(path).removesuffix(f'.{FORMAT}'))
        try:
            with (
                open(path, 'rb') as stream,
                zstandard.ZstdDecompressor().stream_reader(stream) as source,
                open(plain, 'wb') as target,
            ):
                shutil.copyfileobj(source, target)
        except zstandard.ZstdError as error:
            raise BrokenFile(f"'{path}' is damaged ({error})") from error
        yield plain


def with_plain_data(messages: Iterator[RecordedMessage]) -> Iterator[RecordedMessage]:
    """
    Decompress the data of messages.

    Parameters
    ----------
    messages
        The messages as they were recorded.

    Yields
    ------
    RecordedMessage
        The same, serialized.

    Raises
    ------
    BrokenFile
        The data of a message are damaged.

    """
    decompressor = zstandard.ZstdDecompressor()
    for message in messages:
        try:
            size = zstandard.get_frame_parameters(message.data).content_size
            if size > LARGEST_BYTES:
                raise zstandard.ZstdError(f'it claims to have {size} bytes')
            data = decompressor.decompress(message.data)
        except zstandard.ZstdError as error:
            raise BrokenFile(
                f"A message on '{message.topic}' is not compressed with {FORMAT}, as "
                f'metadata.yaml says ({error})'
            ) from error
        yield message._replace(data=data)
