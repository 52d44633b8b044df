# SPDX-License-Identifier: Apache-2.0
"""The handlers of log records."""

from __future__ import annotations

from collections.abc import Callable
import logging
from typing import Optional, TextIO

from launch.logging._lost_files import LostFiles
from launch.logging._screen import screen


class ScreenHandler(logging.Handler):
    """Handler that writes records to the screen."""

    def emit(self, record: logging.LogRecord) -> None:
        """
        Write a record to the screen.

        Parameters
        ----------
        record
            The record.

        """
        screen.write_line(self.format(record))


class LogFileHandler(logging.Handler):
    """
    Handler that writes records to a file, which is opened on the first record.

    Parameters
    ----------
    path
        Function that returns the path of the file when it is opened.
    lost_files
        Reports the file if it cannot be written.

    """

    def __init__(self, path: Callable[[], str], lost_files: LostFiles) -> None:
        super().__init__()
        self._lost_files = lost_files
        self._path = path
        self._file: Optional[TextIO] = None
        self._failed = False
        self._name = ''

    def emit(self, record: logging.LogRecord) -> None:
        """
        Write a record to the file.

        Parameters
        ----------
        record
            The record.

        """
        self.write_line(self.format(record))

    def write_line(self, text: str) -> None:
        """
        Write a line to the file; after a failure, nothing more is written.

        Parameters
        ----------
        text
            The line, without a line break at its end.

        """
        if self._failed:
            return
        try:
            if self._file is None:
                self._name = self._path()
                self._file = open(  # noqa: SIM115
                    self._name, 'a', buffering=1, encoding='utf-8', errors='backslashreplace'
                )
            self._file.write(text + '\n')
        except OSError as error:
            self._failed = True
            self._lost_files.add(self._name, error.strerror or str(error))

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            try:
                self._file.close()
            except OSError:
                self._failed = True
            self._file = None
        super().close()
