# SPDX-License-Identifier: Apache-2.0
"""Read sentences by phrases, and write phrases down for speech recognisers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
import re
from typing import Any

from llm_planner.phrases import Choice, Option, Phrase, Series, Slot, Word
from llm_planner.spoken_numbers import jsgf_digits, jsgf_of, NUMBER_WORDS, numbers_at, UNITS

__all__ = ['Bindings', 'Grammar', 'tokenized']

_WORD = re.compile(r"\d+(?:\.\d+)?|[^\W\d_]+(?:'[^\W\d_]+)*|,")
_CONTRACTIONS = {
    "what's": 'what is', "where's": 'where is', "who's": 'who is', "i'd": 'i would',
    "that's": 'that is', "it's": 'it is', "there's": 'there is', "what're": 'what are',
    "let's": 'let us',
}  # fmt: skip
Bindings = tuple[tuple[str, Any], ...]
"""What the slots of a phrase stand for, by name, in the order in which they were said. The value
is that of a list, a float, a text, or, for a rule, a further `Bindings`."""


def tokenized(text: str) -> list[str]:
    """
    Return the words of a sentence in lower case, commas, and numbers; units as one word each.

    Parameters
    ----------
    text
        What was said or typed. What is no word, number or comma parts words.

    """
    lower = text.lower().replace('\u2019', "'").replace('°', ' degrees ')
    for short, long in _CONTRACTIONS.items():
        lower = re.sub(rf'\b{short}\b', long, lower)
    lower = re.sub(r"\b(\w+)'s\b", r'\1', lower)
    lower = re.sub(r'(\d)([a-z])', r'\1 \2', lower)
    words = [str(each) for each in _WORD.findall(lower)]
    after_number = [False, *(each in NUMBER_WORDS or each[0].isdigit() for each in words)]
    return [
        UNITS.get(each, each) if follows else each for each, follows in zip(words, after_number)
    ]


@dataclass
class Grammar:
    """
    Rules, lists and numbers that slots of phrases stand for.

    Attributes
    ----------
    rules
        Phrases by the names of slots.
    lists
        By the names of slots: texts that can be said, each with its value.
    numbers
        Units by the names of slots: metres, degrees or seconds.
    texts
        Slots that stand for one word or more, whatever they are.

    """

    rules: Mapping[str, Phrase] = field(default_factory=dict)
    lists: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    numbers: Mapping[str, str] = field(default_factory=dict)
    texts: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        self._by_first: dict[str, dict[str, list[tuple[list[str], Any]]]] = {}
        for name, values in self.lists.items():
            table: dict[str, list[tuple[list[str], Any]]] = {}
            for text, value in values.items():
                words = tokenized(text)
                if words:
                    table.setdefault(words[0], []).append((words, value))
            for entries in table.values():
                entries.sort(key=lambda entry: -len(entry[0]))
            self._by_first[name] = table
        self._beginnings: dict[int, tuple[Phrase, frozenset[str] | None]] = {}

    def beginnings(self, phrase: Phrase) -> frozenset[str] | None:
        """
        Return the words with which a phrase can begin; None if that can be any word, or none.

        Parameters
        ----------
        phrase
            It is kept, as what was found.

        """
        found = self._beginnings.get(id(phrase))
        if found is None:
            words, is_open = self._first_words(phrase)
            found = self._beginnings[id(phrase)] = phrase, None if is_open else words
        return found[1]

    def _first_words(self, phrase: Phrase) -> tuple[frozenset[str], bool]:
        """Return the words with which a phrase can begin, and whether it can do without them."""
        if isinstance(phrase, Word):
            return frozenset((phrase.text,)), False
        if isinstance(phrase, Option):
            return self._first_words(phrase.part)[0], True
        if isinstance(phrase, Slot):
            if phrase.rule in self._by_first:
                return frozenset(self._by_first[phrase.rule]), False
            rule = self.rules.get(phrase.rule)
            return self._first_words(rule) if rule is not None else (frozenset(), True)
        found: frozenset[str] = frozenset()
        is_open = isinstance(phrase, Series)
        for part in phrase.parts:
            words, is_part_open = self._first_words(part)
            found |= words
            if isinstance(phrase, Choice):
                is_open = is_open or is_part_open
            elif not is_part_open:
                return found, False
        return found, is_open

    def matches(
        self, phrase: Phrase, tokens: Sequence[str], at: int = 0
    ) -> Iterator[tuple[int, Bindings]]:
        """
        Yield each way in which a phrase can be read from a place on, the longest choices first.

        Parameters
        ----------
        phrase
            What is looked for.
        tokens, at
            The words, and the index of the first one.

        Yields
        ------
        int, Bindings
            The index behind the last word, and what the slots stand for.

        """
        if isinstance(phrase, Word):
            if at < len(tokens) and tokens[at] == phrase.text:
                yield at + 1, ()
        elif isinstance(phrase, Slot):
            for end, value in self._slot(phrase.rule, tokens, at):
                yield end, ((phrase.name, value),)
        elif isinstance(phrase, Choice):
            for part in phrase.parts:
                if self._may_begin(part, tokens, at):
                    yield from self.matches(part, tokens, at)
        elif isinstance(phrase, Option):
            if self._may_begin(phrase.part, tokens, at):
                yield from self.matches(phrase.part, tokens, at)
            yield at, ()
        else:
            yield from self._in_turn(phrase.parts, 0, tokens, at)

    def _may_begin(self, phrase: Phrase, tokens: Sequence[str], at: int) -> bool:
        """Whether a phrase can begin with the word of a place, as far as is seen at once."""
        words = self.beginnings(phrase)
        return words is None or (at < len(tokens) and tokens[at] in words)

    def _in_turn(
        self, parts: Sequence[Phrase], done: int, tokens: Sequence[str], at: int
    ) -> Iterator[tuple[int, Bindings]]:
        if done == len(parts):
            yield at, ()
        elif self._may_begin(parts[done], tokens, at):
            for middle, first in self.matches(parts[done], tokens, at):
                for end, rest in self._in_turn(parts, done + 1, tokens, middle):
                    yield end, first + rest

    def _slot(self, rule: str, tokens: Sequence[str], at: int) -> Iterator[tuple[int, Any]]:
        if rule in self._by_first:
            if at < len(tokens):
                for words, value in self._by_first[rule].get(tokens[at], ()):
                    end = at + len(words)
                    if list(tokens[at:end]) == words:
                        yield end, value
        elif rule in self.rules:
            yield from self.matches(self.rules[rule], tokens, at)
        elif rule in self.numbers:
            yield from numbers_at(tokens, at, self.numbers[rule])
        elif rule in self.texts:
            for end in range(at + 1, len(tokens) + 1):
                yield end, ' '.join(tokens[at:end])

    def to_jsgf(
        self, name: str, command: str, phrases: Mapping[str, Phrase],
        shown: Sequence[str] = (),
    ) -> str:  # fmt: skip
        """
        Return the grammar of a speech recogniser.

        What has a slot for any text, or for a list without entries, is left out: a recogniser
        knows its words beforehand.

        Parameters
        ----------
        name
            The name of the grammar.
        command
            The expansion of the public rule `<command>`; `<name>` stands for another rule.
        phrases
            Further rules by their names.
        shown
            Commands for the documentation comment of the public rule, as `@example`: recognisers
            of free speech can learn from them what is likely.

        Returns
        -------
        str
            The text of a grammar in JSGF 1.0.

        """
        usable = {slot for slot, values in self.lists.items() if values} | {*self.numbers}
        pending = dict(self.rules)
        while True:
            more = {
                n for n, phrase in pending.items() if _jsgf(phrase, usable) and n not in usable
            }
            if not more:
                break
            usable |= more
        lines = ['#JSGF V1.0;', f'grammar {name};']
        if shown:
            lines += ['/**', *(f' * @example {example}' for example in shown), ' */']
        lines.append(f'public <command> = {command};')
        for rule, phrase in {**phrases, **self.rules}.items():
            if text := _jsgf(phrase, usable):
                lines.append(f'<{rule}> = {text};')
        for slot, values in self.lists.items():
            if values:
                spoken = ' | '.join(' '.join(tokenized(text)) for text in values)
                lines.append(f'<{slot}> = {spoken};')
        for slot, unit in self.numbers.items():
            lines.append(jsgf_of(slot, unit))
        if self.numbers:
            lines.append(jsgf_digits())
        return '\n'.join(lines) + '\n'


def _jsgf(phrase: Phrase, usable: set[str]) -> str:
    """Return a phrase in JSGF; nothing if it cannot be said without a slot that is not usable."""
    if isinstance(phrase, Word):
        return '' if phrase.text == ',' else phrase.text
    if isinstance(phrase, Slot):
        return f'<{phrase.rule}>' if phrase.rule in usable else ''
    if isinstance(phrase, Option):
        inner = _jsgf(phrase.part, usable)
        return f'[{inner}]' if inner else '<NULL>'
    parts = [_jsgf(part, usable) for part in phrase.parts]
    if isinstance(phrase, Choice):
        said = [part for part in parts if part]
        return f'({" | ".join(said)})' if said else ''
    return ' '.join(part for part in parts if part != '<NULL>') if all(parts) else ''
