# SPDX-License-Identifier: Apache-2.0
"""Truncated or damaged files: translation of library exceptions to error messages."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import errno
import io
import os
import struct

from mcap.exceptions import InvalidMagic, McapError
from ros2bag.storage.bounded_chunks import ChunkTooLarge
from ros2bag.storage.errors import BagError
import yaml
from zstandard import ZstdError

__all__ = ['DAMAGE', 'BoundedFile', 'BrokenFile', 'damage_told']

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
    ZstdError,
    struct.error,
    yaml.YAMLError,
)
LARGE_BYTES = 1024 * 1024


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
            f"the file '{path}' of the recording is missing. To go on without it: "
            f'ros2 bag reindex {os.path.dirname(path)}'
        ) from error
    except OSError as error:
        if error.errno != errno.EINVAL:
            raise BagError(f"'{path}' cannot be read: {error.strerror}") from error
        raise _broken(path, error) from error
    except ChunkTooLarge as error:
        raise BrokenFile(
            f"'{path}' is not read: {error}. What else it has can be saved: "
            f'ros2 bag recover {os.path.dirname(path) or path}'
        ) from error
    except DAMAGE as error:
        if isinstance(error, InvalidMagic) and not path.endswith('.mcap'):
            raise BagError(f"'{path}' is not an MCAP file") from error
        raise _broken(path, error) from error


def _broken(path: str, error: BaseException) -> BrokenFile:
    return BrokenFile(
        f"'{path}' was not finished, or is damaged ({type(error).__name__}). "
        f'What it has can be saved: ros2 bag recover {os.path.dirname(path) or path}'
    )
