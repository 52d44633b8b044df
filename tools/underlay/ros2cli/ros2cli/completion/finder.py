# SPDX-License-Identifier: Apache-2.0
"""Quoting of completions where a shell differs from what argcomplete expects."""

from __future__ import annotations

import os
import re

from argcomplete import CompletionFinder


class Finder(CompletionFinder):
    """Completion finder that quotes the words as the shell expects."""

    def quote_completions(
        self, completions: list[str], cword_prequote: str, last_wordbreak_pos: int | None
    ) -> list[str]:
        """
        Quote words for bash; zsh does its own quoting in the style of the line.

        Parameters
        ----------
        completions
            The words that complete the line.
        cword_prequote
            The opening quote of the word on the line, or ''.
        last_wordbreak_pos
            Where the shell breaks the word, as argcomplete passes it.

        Returns
        -------
        list of str
            The words as the shell is to receive them.

        """
        is_message = not cword_prequote and all(word.startswith('{') for word in completions)
        if is_message:
            completions = [_between_quotes(word) for word in completions]
        if os.environ.get('_ARGCOMPLETE_SHELL') == 'zsh':
            return [self._for_zsh(word) for word in completions]
        if is_message:
            return completions
        found = super().quote_completions(completions, cword_prequote, last_wordbreak_pos)
        return [_with_variable(word) for word in found]

    def _for_zsh(self, word: str) -> str:
        """Escape colons in a word, because zsh puts one before the description."""
        escaped = word.replace('\\', '\\\\').replace(':', '\\:')
        self._display_completions[escaped] = self._display_completions.get(word, '')
        return escaped


def _between_quotes(word: str) -> str:
    """Quote a whole message as a word that is easy to edit."""
    escaped = re.sub(r'([\\"$`])', r'\\\1', word)
    return f'"{escaped}"'


def _with_variable(word: str) -> str:
    """Unescape the leading `$` of a word such as `$HOME/bags`, so that the shell expands it."""
    return word[1:] if word.startswith('\\$') else word
