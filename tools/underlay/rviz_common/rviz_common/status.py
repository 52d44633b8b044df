# SPDX-License-Identifier: Apache-2.0
"""What is reported of displays: status messages, errors, and their text for the page."""

from __future__ import annotations

from enum import IntEnum
import re

__all__ = ['MARKS', 'Level', 'Statuses', 'described_error', 'escaped', 'printable', 'status_text']


class Level(IntEnum):
    """The severity of a status message."""

    OK = 0
    WARN = 1
    ERROR = 2


class Statuses:
    """Status messages of a display by subject (`Topic`, `Transform`), the newest of each."""

    def __init__(self) -> None:
        self._sentences: dict[str, tuple[Level, str]] = {}

    def say(self, subject: str, level: Level, sentence: str) -> None:
        """
        Set the message about a subject, replacing the previous one.

        Parameters
        ----------
        subject
            What it is about, such as `Topic` or `Transform`.
        level
            The severity.
        sentence
            The message for the user.

        """
        self._sentences[subject] = level, sentence

    def forget(self, subject: str) -> None:
        """
        Remove the message about a subject, if there is one.

        Parameters
        ----------
        subject
            What it is about.

        """
        self._sentences.pop(subject, None)

    def clear(self) -> None:
        """Remove all messages."""
        self._sentences.clear()

    @property
    def level(self) -> Level:
        """The worst level."""
        return max((level for level, _ in self._sentences.values()), default=Level.OK)

    def items(self) -> list[tuple[str, Level, str]]:
        """Return the subject, level and text of all messages."""
        return [(subject, *said) for subject, said in list(self._sentences.items())]


def described_error(error: Exception) -> str:
    """
    Format an error with the file and line where it was raised, and its type.

    Parameters
    ----------
    error
        The error; without a traceback, the file and line are left out.

    """
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    place = '' if trace is None else f'{trace.tb_frame.f_code.co_filename}:{trace.tb_lineno}: '
    return f'{place}{type(error).__name__}: {error}'


MARKS = {Level.OK: '✔', Level.WARN: '⚠', Level.ERROR: '✖'}
SPECIAL = re.compile(r'([\\`*_{}\[\]<>#|~])')
LONGEST = 500


def printable(text: str) -> str:
    """
    Replace characters that cannot be encoded as UTF-8: file names may have undecodable bytes.

    Parameters
    ----------
    text
        Any text.

    """
    return text.encode(errors='replace').decode()


def escaped(text: str) -> str:
    """
    Escape a text for Markdown, as one line.

    Parameters
    ----------
    text
        Any text; only the first 500 characters are kept.

    """
    text = printable(text)
    if len(text) > LONGEST:
        text = f'{text[:LONGEST]} ...'
    return SPECIAL.sub(r'\\\1', text).replace('\n', ' ')


def status_text(status: Statuses) -> str:
    """
    Format the status messages of a display as Markdown, with a paragraph for each subject.

    Parameters
    ----------
    status
        The status of the display.

    """
    return '\n\n'.join(
        f'{MARKS[level]} **{escaped(subject)}**: {escaped(sentence)}'
        for subject, level, sentence in status.items()
    )
