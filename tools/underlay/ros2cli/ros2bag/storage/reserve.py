# SPDX-License-Identifier: Apache-2.0
"""Disk space that is reserved for the end of a recording."""

from __future__ import annotations

import errno
import os

__all__ = ['FILE_NAME', 'Reserve']

FILE_NAME = '.reserve'
RESERVED_BYTES = 4 * 1024 * 1024


class Reserve:
    """
    Reserved disk space, to be released when the disk is full or the recording ends.

    Parameters
    ----------
    folder
        Where to create the file that takes the space (4 MiB).

    Raises
    ------
    OSError
        The disk does not have enough space left.

    """

    def __init__(self, folder: str) -> None:
        self._path = os.path.join(folder, FILE_NAME)
        try:
            with open(self._path, 'xb') as stream:
                os.posix_fallocate(stream.fileno(), 0, RESERVED_BYTES)
        except OSError as error:
            self.release()
            # Other errors are file size limits, or file systems without support for preallocation.
            if error.errno == errno.ENOSPC:
                raise

    def release(self) -> None:
        """Release the disk space; may be called more than once."""
        if os.path.exists(self._path):
            os.unlink(self._path)
