# SPDX-License-Identifier: Apache-2.0
"""Parse sentences with phrases, and export phrases as JSGF for speech recognisers."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
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
"""The values bound to the slots of a phrase, by name, in spoken order. A value is that of a list
entry, a float, a text, or, for a rule, nested `Bindings`."""


def tokenized(text: str) -> list[str]:
    """
    Tokenise a sentence into lower-case words, numbers and commas, with normalised units.

    Parameters
    ----------
    text
        The sentence, as spoken or typed. All other characters separate words.

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
    Grammar that defines the slots of phrases: rules, word lists, numbers and free text.

    Attributes
    ----------
    rules
        Phrases by slot name.
    lists
        Spoken texts with their values, by slot name.
    numbers
        Units by slot name: metres, degrees or seconds.
    texts
        Slots for free text: one word or more, whatever they are.
    spoken
        The texts of a list that a speech recogniser should expect, by slot name; by default all.
        What is typed may be any text of the list.
    weights
        How likely a word is for a speech recogniser, in comparison with a word of weight 1.

    """

    rules: Mapping[str, Phrase] = field(default_factory=dict)
    lists: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    numbers: Mapping[str, str] = field(default_factory=dict)
    texts: frozenset[str] = frozenset()
    spoken: Mapping[str, Collection[str]] = field(default_factory=dict)
    weights: Mapping[str, float] = field(default_factory=dict)

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
        Compute the possible first words of a phrase; None if any word, or none, can be first.

        Parameters
        ----------
        phrase
            The phrase; it is cached together with the result.

        """
        found = self._beginnings.get(id(phrase))
        if found is None:
            words, is_open = self._first_words(phrase)
            found = self._beginnings[id(phrase)] = phrase, None if is_open else words
        return found[1]

    def _first_words(self, phrase: Phrase) -> tuple[frozenset[str], bool]:
        """Compute the first words of a phrase, and whether it may also begin otherwise."""
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
        Yield each match of a phrase at an index, the longest list entries first.

        Parameters
        ----------
        phrase
            The phrase to match.
        tokens, at
            The words, and the index of the first one.

        Yields
        ------
        int, Bindings
            The index behind the last word, and the bindings of the slots.

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
        """Check quickly, from its first word only, whether a phrase can match at an index."""
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
        Export a JSGF grammar for a speech recogniser.

        Parts that need a slot for free text, or for an empty list, are left out: a recogniser has
        to know its words in advance.

        Parameters
        ----------
        name
            The name of the grammar.
        command
            The expansion of the public rule `<command>`; `<name>` stands for another rule.
        phrases
            Further rules by name.
        shown
            Commands for the documentation comment of the public rule, as `@example`: they can
            prime recognisers of free speech.

        Returns
        -------
        str
            The text of a grammar in JSGF 1.0.

        """
        lists = {
            slot: [text for text in values if text in self.spoken.get(slot, values)]
            for slot, values in self.lists.items()
        }
        usable = {slot for slot, texts in lists.items() if texts} | {*self.numbers}
        pending = dict(self.rules)
        while True:
            more = {
                name
                for name, phrase in pending.items()
                if name not in usable and self._jsgf(phrase, usable)
            }
            if not more:
                break
            usable |= more
        lines = ['#JSGF V1.0;', f'grammar {name};']
        if shown:
            lines += ['/**', *(f' * @example {example}' for example in shown), ' */']
        lines.append(f'public <command> = {command};')
        for rule, phrase in {**phrases, **self.rules}.items():
            if text := self._jsgf(phrase, usable):
                lines.append(f'<{rule}> = {text};')
        for slot, texts in lists.items():
            if texts:
                said = [(' '.join(tokenized(text)), None) for text in texts]
                lines.append(f'<{slot}> = {self._alternatives(said)};')
        for slot, unit in self.numbers.items():
            lines.append(jsgf_of(slot, unit))
        if self.numbers:
            lines.append(jsgf_digits())
        return '\n'.join(lines) + '\n'

    def _jsgf(self, phrase: Phrase, usable: set[str]) -> str:
        """Return a phrase in JSGF; empty if it requires a slot that is not usable."""
        if isinstance(phrase, Word):
            return '' if phrase.text == ',' else phrase.text
        if isinstance(phrase, Slot):
            return f'<{phrase.rule}>' if phrase.rule in usable else ''
        if isinstance(phrase, Option):
            inner = self._jsgf(phrase.part, usable)
            return f'[{inner}]' if inner else '<NULL>'
        parts = [self._jsgf(part, usable) for part in phrase.parts]
        if isinstance(phrase, Choice):
            weights = phrase.weights or (None,) * len(parts)
            pairs = [(part, w) for part, w in zip(parts, weights, strict=True) if part]
            return f'({self._alternatives(pairs)})' if pairs else ''
        return ' '.join(part for part in parts if part != '<NULL>') if all(parts) else ''

    def _alternatives(self, said: Iterable[tuple[str, float | None]]) -> str:
        """Join alternatives in JSGF, with their weights or else those of their first words."""
        parts = []
        for text, own in said:
            weight = self.weights.get(text.partition(' ')[0]) if own is None else own
            parts.append(text if weight is None else f'/{weight:g}/ {text}')
        return ' | '.join(parts)
