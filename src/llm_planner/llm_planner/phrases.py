# SPDX-License-Identifier: Apache-2.0
"""
Common notation of phrases for parsing and for speech recognition.

A phrase is written like an expansion of JSGF (the Java Speech Grammar Format): words, `(a | b)`
for alternatives, `[a]` for optional parts, and `{name}` for a slot, which stands for a rule, a
list of words with their values, a number, or free text. `{name:rule}` names the rule of a slot if
it is not that of the name. `(a | /0.1/ b)` says that b is a tenth as likely as a, which is for
speech recognisers only.
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

_TOKEN = re.compile(r'\{\w+(?::\w+)?\}|/[\d.]+/|[\[\]()|,]|[^\s\[\](){}|,]+')
_WEIGHT = re.compile(r'/[\d.]+/')


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
    """Alternatives, of which one is required, and how likely each is if that was said."""

    parts: tuple[Phrase, ...]
    weights: tuple[float | None, ...] = ()


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
    Return a copy of a phrase in which slots that name no rule refer to other rules.

    Parameters
    ----------
    phrase
        The phrase; it is not changed.
    rules
        The names of the rules by slot name.

    """
    if isinstance(phrase, Slot):
        is_named = phrase.rule != phrase.name
        return phrase if is_named else Slot(phrase.name, rules.get(phrase.name, phrase.rule))
    if isinstance(phrase, Option):
        return Option(with_rules(phrase.part, rules))
    if isinstance(phrase, Series):
        return Series(tuple(with_rules(part, rules) for part in phrase.parts))
    if isinstance(phrase, Choice):
        return Choice(tuple(with_rules(part, rules) for part in phrase.parts), phrase.weights)
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
        The syntax tree; each slot refers to its rule, or to that of the same name.

    Raises
    ------
    GrammarError
        Brackets do not match, an alternative is empty, or a weight is not a positive number.

    """
    tokens = _TOKEN.findall(text)
    phrase, end = _alternatives(tokens, 0, text)
    if end != len(tokens):
        raise GrammarError(f"The phrase '{text}' has an unmatched '{tokens[end]}'.")
    return phrase


def _alternatives(tokens: Sequence[str], at: int, text: str) -> tuple[Phrase, int]:
    found: list[Phrase] = []
    weights: list[float | None] = []
    while True:
        weight = None
        if at < len(tokens) and _WEIGHT.fullmatch(tokens[at]):
            weight, at = _weight(tokens[at], text), at + 1
        part, at = _sequence(tokens, at, text)
        found.append(part)
        weights.append(weight)
        if at >= len(tokens) or tokens[at] != '|':
            is_plain = len(found) == 1 and weight is None
            return (found[0] if is_plain else Choice(tuple(found), tuple(weights))), at
        at += 1


def _weight(token: str, text: str) -> float:
    try:
        weight = float(token.strip('/'))
    except ValueError:
        weight = 0.0
    if weight <= 0.0:
        raise GrammarError(
            f"The phrase '{text}' has the weight '{token}': write one such as /0.1/."
        )
    return weight


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
            name, _, rule = token[1:-1].partition(':')
            parts.append(Slot(name, rule or name))
        elif _WEIGHT.fullmatch(token):
            raise GrammarError(f"The phrase '{text}' has '{token}' not before an alternative.")
        else:
            parts.append(Word(token))
        at += 1
    if not parts:
        raise GrammarError(f"The phrase '{text}' has an empty alternative.")
    return (parts[0] if len(parts) == 1 else Series(tuple(parts))), at
