# SPDX-License-Identifier: Apache-2.0
"""The formats of the log."""

from __future__ import annotations

import codecs
import logging
import re
from typing import Optional

_SCREEN_FORMATS = {
    'default': '[{levelname}] [{name}]: {message}',
    'default_with_timestamp': '{created:.7f} [{levelname}] [{name}]: {message}',
}
_COLOURS = (36, 32, 33, 35, 34, 96, 92, 93, 95, 94)
_LOG_FORMATS = {
    'default': '{created:.7f} [{levelname}] [{name}]: {message}',
}


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
    from launch.logging._screen import screen

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
        text = codecs.decode(text, 'unicode_escape')
    text = re.sub(r'\{msg(?=[!:}])', '{message', text)
    return logging.Formatter(text, style='{', validate=False)
