# SPDX-License-Identifier: Apache-2.0
"""Example commands for users, web pages and speech recognisers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import cycle, repeat

from llm_planner.phrases import Choice, Option, Phrase, Series, Word
from llm_planner.skills import Skill, Skills

__all__ = ['ExampleWords', 'examples', 'fixed_words', 'worlds_examples']

ExampleWords = Mapping[str, Iterator[str]]
"""Texts for arguments in successive examples, by the type of the argument."""
_NUMBERS = {'metres': 'one metre', 'degrees': 'ninety degrees', 'seconds': 'ten seconds'}


def examples(skill: Skill, skills: Skills, words: ExampleWords) -> list[str]:
    """
    Generate an example command for each phrase of a skill.

    Parameters
    ----------
    skill, skills
        The skill, and all skills, whose rules are used.
    words
        The texts that stand for arguments.

    Returns
    -------
    list[str]
        The first alternative of each phrase, without optional parts.

    """
    said = (_example(saying.phrase, skill, skills.rules, words) for saying in skill.sayings)
    return list(dict.fromkeys(said))


def fixed_words() -> ExampleWords:
    """Return argument texts that do not depend on the world; two places alternate."""
    fixed = {
        'places': 'the kitchen and the hall',
        'object': 'the red mug',
        'objects': 'red mugs',
        'target': 'the kitchen',
        'text': 'dinner is ready',
    }
    words: dict[str, Iterator[str]] = {kind: repeat(text) for kind, text in fixed.items()}
    return {**words, 'place': cycle(('the desk', 'the kitchen table'))}


def _words_of(skills: Skills, places: Sequence[str]) -> ExampleWords:
    """
    Return argument texts that vary between examples, to show many of them.

    Parameters
    ----------
    skills
        The skills, whose vocabulary has the classes and colours of objects.
    places
        The names of places, as spoken.

    """

    def of(name: str) -> Iterator[str]:
        """Cycle through the first word for each value of a list."""
        return cycle([words[0] for words in skills.vocabulary.get(name, {}).values()] or [''])

    def joined(*parts: Iterator[str]) -> Iterator[str]:
        return (' '.join(filter(None, each)) for each in zip(*parts, strict=False))

    named = cycle([f'the {place}' for place in places])
    things = joined(repeat('the'), of('colour'), of('class'))
    return {
        'place': named,
        'places': joined(named, repeat('and'), named),
        'object': things,
        'objects': of('classes'),
        'target': (each for pair in zip(named, things, strict=False) for each in pair),
        'text': repeat('hello'),
    }


def worlds_examples(skills: Skills, places: Sequence[str]) -> list[str]:
    """
    Generate examples for a recogniser: one for each skill, and one for each place.

    Parameters
    ----------
    skills
        The skills; those with free text are left out.
    places
        The names of places, as spoken.

    """
    words = _words_of(skills, places)
    said: list[str] = []
    for skill in skills:
        kinds = {argument.kind for argument in skill.arguments.values()}
        if 'text' not in kinds and (places or not kinds & {'place', 'places', 'target'}):
            said += examples(skill, skills, words)[:1]
    return [*said, *(f'go to the {place}' for place in places)]


def _example(
    phrase: Phrase, skill: Skill, rules: Mapping[str, Phrase], words: ExampleWords
) -> str:
    match phrase:
        case Word():
            return phrase.text
        case Option():
            return ''
        case Choice():
            return _example(phrase.parts[0], skill, rules, words)
        case Series():
            parts = (_example(each, skill, rules, words) for each in phrase.parts)
            return ' '.join(filter(None, parts))
    argument = skill.arguments.get(phrase.name)
    if argument is None:
        return _example(rules[phrase.rule], skill, rules, words)
    if argument.kind == 'choice':
        return next(iter(argument.values.values()))[0]
    return _NUMBERS[argument.unit] if argument.kind == 'number' else next(words[argument.kind])
