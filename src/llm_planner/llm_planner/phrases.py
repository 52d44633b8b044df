# SPDX-License-Identifier: Apache-2.0
"""
Common notation of phrases for parsing and for speech recognition.

A phrase is written like an expansion of JSGF (the Java Speech Grammar Format): words, `(a | b)`
for alternatives, `[a]` for optional parts, and `{name}` for a slot, which stands for a rule, a
list of words with their values, a number, or free text.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
import re

from humanoid_common.errors import UserError

__all__ = [
    'Choice', 'GrammarError', 'Option', 'Phrase', 'Series', 'Slot', 'Word', 'parse_phrase',
    'part_of', 'with_rules',
]  # fmt: skip

_TOKEN = re.compile(r'\{\w+\}|[\[\]()|,]|[^\s\[\](){}|,]+')


class GrammarError(UserError):
    """A phrase or a word list is invalid; the message states why."""


@dataclass(frozen=True)
class Word:
    """A required word."""

    text: str


@dataclass(frozen=True)
class Series:
    """A sequence of parts."""

    parts: tuple[Phrase, ...]


@dataclass(frozen=True)
class Choice:
    """Alternatives, of which one is required."""

    parts: tuple[Phrase, ...]


@dataclass(frozen=True)
class Option:
    """An optional part."""

    part: Phrase


@dataclass(frozen=True)
class Slot:
    """A slot for a rule, a list, a number or a text, and the name to which its value is bound."""

    name: str
    rule: str


Phrase = Word | Series | Choice | Option | Slot


def part_of(phrase: Phrase) -> Iterator[Phrase]:
    """
    Traverse a phrase and all its parts in pre-order.

    Parameters
    ----------
    phrase
        The root of the tree.

    Yields
    ------
    Phrase
        The phrase itself first.

    """
    yield phrase
    parts: tuple[Phrase, ...] = ()
    if isinstance(phrase, Option):
        parts = (phrase.part,)
    elif isinstance(phrase, Series | Choice):
        parts = phrase.parts
    for part in parts:
        yield from part_of(part)


def with_rules(phrase: Phrase, rules: Mapping[str, str]) -> Phrase:
    """
    Return a copy of a phrase in which slots refer to other rules.

    Parameters
    ----------
    phrase
        The phrase; it is not changed.
    rules
        The names of the rules by slot name.

    """
    if isinstance(phrase, Slot):
        return Slot(phrase.name, rules.get(phrase.name, phrase.rule))
    if isinstance(phrase, Option):
        return Option(with_rules(phrase.part, rules))
    if isinstance(phrase, Series):
        return Series(tuple(with_rules(part, rules) for part in phrase.parts))
    if isinstance(phrase, Choice):
        return Choice(tuple(with_rules(part, rules) for part in phrase.parts))
    return phrase


def parse_phrase(text: str) -> Phrase:
    """
    Parse a phrase.

    Parameters
    ----------
    text
        The phrase in the notation of this module.

    Returns
    -------
    Phrase
        The syntax tree; each slot refers to the rule of the same name.

    Raises
    ------
    GrammarError
        Brackets do not match, or an alternative is empty.

    """
    tokens = _TOKEN.findall(text)
    phrase, end = _alternatives(tokens, 0, text)
    if end != len(tokens):
        raise GrammarError(f"The phrase '{text}' has an unmatched '{tokens[end]}'.")
    return phrase


def _alternatives(tokens: Sequence[str], at: int, text: str) -> tuple[Phrase, int]:
    found: list[Phrase] = []
    while True:
        part, at = _sequence(tokens, at, text)
        found.append(part)
        if at >= len(tokens) or tokens[at] != '|':
            return (found[0] if len(found) == 1 else Choice(tuple(found))), at
        at += 1


def _sequence(tokens: Sequence[str], at: int, text: str) -> tuple[Phrase, int]:
    parts: list[Phrase] = []
    while at < len(tokens) and tokens[at] not in '|])':
        token = tokens[at]
        if token in '[(':
            inner, at = _alternatives(tokens, at + 1, text)
            if at >= len(tokens) or tokens[at] != {'[': ']', '(': ')'}[token]:
                raise GrammarError(f"The phrase '{text}' has a '{token}' that is not closed.")
            parts.append(Option(inner) if token == '[' else inner)
        elif token[0] == '{':
            parts.append(Slot(token[1:-1], token[1:-1]))
        else:
            parts.append(Word(token))
        at += 1
    if not parts:
        raise GrammarError(f"The phrase '{text}' has an empty alternative.")
    return (parts[0] if len(parts) == 1 else Series(tuple(parts))), at
