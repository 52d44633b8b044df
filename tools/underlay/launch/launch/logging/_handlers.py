# SPDX-License-Identifier: Apache-2.0
"""Write log records: formats, handlers, and the report of log files that cannot be written."""

from __future__ import annotations

from collections.abc import Callable
import logging
import re
from typing import Optional, TextIO

from launch.logging._screen import screen

_SCREEN_FORMATS = {
    'default': '[{levelname}] [{name}]: {message}',
    'default_with_timestamp': '{created:.7f} [{levelname}] [{name}]: {message}',
}
_COLOURS = (36, 32, 33, 35, 34, 96, 92, 93, 95, 94)
_LOG_FORMATS = {
    'default': '{created:.7f} [{levelname}] [{name}]: {message}',
}
_NODE_ERROR = re.compile(
    r'\[\*\*\* LOG ERROR #\d+ \*\*\*\] .*\{Failed writing to file (?P<path>.*): (?P<reason>.*)\}'
)
"""Error that spdlog, which writes the log files of nodes, prints each second on a failure."""


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


def screen_formatter(text: Optional[str]) -> logging.Formatter:
    """
    Create the formatter of the screen.

    Parameters
    ----------
    text
        A brace-style format, or the name of a known one: `default` (also for None) or
        `default_with_timestamp`.

    """
    return _formatter(_SCREEN_FORMATS.get(text or 'default', text or ''))


def log_formatter(text: Optional[str]) -> logging.Formatter:
    """
    Create the formatter of the main log file.

    Parameters
    ----------
    text
        A brace-style format, or the name of a known one: `default` (also for None).

    """
    return _formatter(_LOG_FORMATS.get(text or 'default', text or ''))


def bare_formatter() -> logging.Formatter:
    """Create the formatter of a process's lines that are already formatted."""
    return _formatter('{message}')


def label_formatter(label: str) -> logging.Formatter:
    """
    Create the formatter of a process's lines on the screen, which colours labels on a terminal.

    Parameters
    ----------
    label
        The label of the process, whose number selects the colour.

    """
    return _Coloured(label) if screen.has_colours() else bare_formatter()


class _Coloured(logging.Formatter):
    """Formatter that colours the label of the process at the start of each line."""

    def __init__(self, label: str) -> None:
        """Create the formatter; the number in the label selects the colour."""
        super().__init__('{message}', style='{', validate=False)
        number = label.rpartition('-')[2]
        colour = _COLOURS[int(number) % len(_COLOURS) if number.isdigit() else 0]
        self._plain = f'[{label}]'
        self._coloured = f'\x1b[{colour}m{self._plain}\x1b[0m'

    def format(self, record: logging.LogRecord) -> str:  # noqa: A003, RUF100
        """Format the lines of the message."""
        text = record.getMessage()
        if text.startswith(self._plain):
            text = text.replace(self._plain, self._coloured, 1)
        return text.replace(f'\n{self._plain}', f'\n{self._coloured}')


def stamped_formatter() -> logging.Formatter:
    """Create the formatter of a process's lines in the main log file."""
    return _Stamped()


class _Stamped(logging.Formatter):
    """Formatter that prepends a timestamp to each line of a message."""

    def format(self, record: logging.LogRecord) -> str:  # noqa: A003, RUF100
        """Format the lines of the message."""
        stamp = f'{record.created:.7f} '
        return stamp + record.getMessage().replace('\n', f'\n{stamp}')


def _formatter(text: str) -> logging.Formatter:
    """Create a brace-style formatter; backslash escapes are interpreted, {msg} is the message."""
    if '\\' in text:
        text = text.encode('latin-1', 'backslashreplace').decode('unicode_escape')
    text = re.sub(r'\{msg(?=[!:}])', '{message', text)
    return logging.Formatter(text, style='{', validate=False)


class LostFiles:
    """Reporter of log files that cannot be written: each reason once, with the first file."""

    def __init__(self) -> None:
        self._reasons: set[str] = set()

    def add(self, path: str, reason: str) -> None:
        """
        Report a log file that cannot be written any more, unless the reason has been reported.

        Parameters
        ----------
        path
            The path of the file.
        reason
            Why it cannot be written.

        """
        if reason not in self._reasons:
            self._reasons.add(reason)
            screen.write_line(
                f"[WARNING] [launch]: log files can no longer be written, '{path}' first: "
                f'{reason}. Everything else continues; free some space there, or set ROS_LOG_DIR '
                'to another folder for the next start.'
            )

    def without_errors(self, lines: list[str]) -> list[str]:
        """
        Filter out, and report, a node's messages that its log file cannot be written.

        Parameters
        ----------
        lines
            The lines of the output.

        Returns
        -------
        list of str
            The lines without these messages.

        """
        kept = []
        for line in lines:
            found = _NODE_ERROR.match(line) if line.startswith('[***') else None
            if found is None:
                kept.append(line)
            else:
                self.add(found['path'], found['reason'])
        return kept
