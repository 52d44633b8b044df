# SPDX-License-Identifier: Apache-2.0
"""Split the command lines in launch files."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Optional

from launch.substitution import Substitution
from launch.substitutions.text_substitution import TextSubstitution

_PROTECTED_BY_BACKSLASH = {'': None, "'": '', '"': '"\\'}


def command_words(parts: Iterable[Substitution]) -> list[list[Substitution]]:
    """
    Split a command line into words, as a shell does.

    Plain strings are split; the results of substitutions are never split.

    Parameters
    ----------
    parts
        The command line as substitutions.

    Returns
    -------
    list of list of Substitution
        The parts of each word.

    Raises
    ------
    ValueError
        A quote is never closed.

    """
    splitter = _Splitter()
    for part in parts:
        if isinstance(part, TextSubstitution):
            splitter.add_text(part.text)
        else:
            splitter.add(part)
    return splitter.finish()


class _Splitter:
    """Splitter that collects the words."""

    def __init__(self) -> None:
        self._words: list[list[Substitution]] = []
        self._word: Optional[list[Substitution]] = None
        self._plain = ''
        self._quote = ''

    def add(self, part: Substitution) -> None:
        """Add a substitution to the current word."""
        self._flush()
        self._begin().append(part)

    def add_text(self, text: str) -> None:
        """Add a string, which may end words and start others."""
        characters = iter(text)
        for character in characters:
            if character == '\\':
                self._escaped(next(characters, ''))
            elif character == self._quote:
                self._quote = ''
            elif not self._quote and character in '\'"':
                self._quote = character
                self._begin()
            elif not self._quote and character.isspace():
                self._end()
            else:
                self._begin()
                self._plain += character

    def _escaped(self, character: str) -> None:
        """Add a character after a backslash, which is kept if it escapes nothing."""
        protected = _PROTECTED_BY_BACKSLASH[self._quote]
        self._begin()
        if protected is None or character in protected:
            self._plain += character
            return
        self._plain += '\\'
        self.add_text(character)

    def finish(self) -> list[list[Substitution]]:
        """Complete the last word and return all words."""
        if self._quote:
            raise ValueError(f'the quote {self._quote} is never closed in a command line')
        self._end()
        return self._words

    def _begin(self) -> list[Substitution]:
        if self._word is None:
            self._word = []
        return self._word

    def _flush(self) -> None:
        if self._plain:
            self._begin().append(TextSubstitution(text=self._plain))
        self._plain = ''

    def _end(self) -> None:
        self._flush()
        if self._word is not None:
            self._words.append(self._word or [TextSubstitution(text='')])
        self._word = None
