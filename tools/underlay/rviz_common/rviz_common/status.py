# SPDX-License-Identifier: Apache-2.0
"""The status of a display."""

from __future__ import annotations

from enum import IntEnum

__all__ = ['Level', 'Statuses']


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
