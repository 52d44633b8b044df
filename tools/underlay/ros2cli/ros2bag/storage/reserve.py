# SPDX-License-Identifier: Apache-2.0
"""Room on the disk that is kept free for the end of a recording."""

from __future__ import annotations

import errno
import os

__all__ = ['FILE_NAME', 'Reserve']

FILE_NAME = '.reserve'
RESERVED_BYTES = 4 * 1024 * 1024


class Reserve:
    """
    Reserved disk space, which is released when the disk is full or the work done.

    Parameters
    ----------
    folder
        Where to create the file that takes the space (4 MiB).

    Raises
    ------
    OSError
        The disk has not as much space left.

    """

    def __init__(self, folder: str) -> None:
        self._path = os.path.join(folder, FILE_NAME)
        try:
            with open(self._path, 'xb') as stream:
                os.posix_fallocate(stream.fileno(), 0, RESERVED_BYTES)
        except OSError as error:
            self.release()
            # Other errors are limits on the size of a file, or file systems that cannot do it.
            if error.errno == errno.ENOSPC:
                raise

    def release(self) -> None:
        """Give the room back; more than once does no harm."""
        if os.path.exists(self._path):
            os.unlink(self._path)
