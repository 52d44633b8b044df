# SPDX-License-Identifier: Apache-2.0
"""File that buffers data while the disk is full, so that no write is partial."""

from __future__ import annotations

from contextlib import suppress
import fcntl

__all__ = ['PatientFile', 'is_being_written']


class PatientFile:
    """
    New unbuffered file: written data persist, even if the process is killed.

    A write never fails and is never partial. Data that cannot be written are kept, `check` raises
    the reason, and `retry` writes them when there is space again. The file is locked while open.

    Parameters
    ----------
    path
        The file to create.

    Raises
    ------
    OSError
        The file exists already or cannot be created.

    """

    def __init__(self, path: str) -> None:
        self._file = open(path, 'xb', buffering=0)  # noqa: SIM115
        with suppress(OSError):
            # Some network file systems do not support locks.
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        self._rest = b''
        self._error: OSError | None = None

    def write(self, data: bytes) -> int:
        """
        Write all of the data, now or when there is space again.

        Parameters
        ----------
        data
            The bytes to append.

        Returns
        -------
        int
            The length of the data.

        """
        self._rest += data
        if self._error is None:
            self._write_rest()
        return len(data)

    def tell(self) -> int:
        """Return the file position, including pending data."""
        return self._file.tell() + len(self._rest)

    def flush(self) -> None:
        """Flush nothing, since the file is unbuffered."""

    def check(self) -> None:
        """Raise the error of a failed write that is still pending, if there is one."""
        if self._error is not None:
            raise self._error

    def retry(self) -> None:
        """Write the pending data; raise the error if that fails again."""
        self._error = None
        self._write_rest()
        self.check()

    def close(self) -> None:
        """Close the file, which also unlocks it."""
        self._file.close()

    def _write_rest(self) -> None:
        """Write until nothing is left: a disk that becomes full may accept a part first."""
        try:
            while self._rest:
                count = self._file.write(self._rest)
                self._rest = self._rest[count:]
        except OSError as error:
            self._error = error


def is_being_written(path: str) -> bool:
    """
    Whether a process has this file open as a `PatientFile`.

    Parameters
    ----------
    path
        The file, which exists.

    """
    with open(path, 'rb') as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
    return False
