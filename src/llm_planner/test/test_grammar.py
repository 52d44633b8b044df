# SPDX-License-Identifier: Apache-2.0
"""Phrases: how they are read, what they match, and their form for speech recognisers."""

from __future__ import annotations

from typing import Any

from llm_planner.grammar import Grammar, tokenized
from llm_planner.phrases import GrammarError, parse_phrase, with_rules
import pytest

GRAMMAR = Grammar(
    {'thing': parse_phrase('[{colour}] {class}')},
    {
        'colour': {'red': 'red', 'dark red': 'crimson'},
        'class': {'mug': 'mug', 'cup': 'mug'},
        'none': {},
    },
    {'distance': 'metres', 'angle': 'degrees', 'duration': 'seconds'},
    frozenset(('text',)),
)


def read(phrase: str, text: str) -> list[Any]:
    """Return the bindings of all ways to read a whole text as a phrase."""
    tokens = tokenized(text)
    return [
        dict(bindings)
        for end, bindings in GRAMMAR.matches(parse_phrase(phrase), tokens)
        if end == len(tokens)
    ]


@pytest.mark.parametrize(
    'text, tokens',
    [
        ("What's that?", ['what', 'is', 'that']),
        ('Go, then come-back!', ['go', ',', 'then', 'come', 'back']),
        ('turn 90° left', ['turn', '90', 'degrees', 'left']),
        ('1.5m ahead.', ['1.5', 'metres', 'ahead']),
        ('the robot\u2019s mug', ['the', 'robot', 'mug']),
        ('<b> & 😀', ['b']),
        ('', []),
    ],
)
def test_sentences_become_words(text: str, tokens: list[str]) -> None:
    """Case, punctuation and short forms make no difference."""
    assert tokenized(text) == tokens


def test_alternatives_and_options() -> None:
    """All that is written may be said, and nothing else."""
    phrase = '(go | walk) [back] to {thing}'
    assert read(phrase, 'walk to mug') == [{'thing': (('class', 'mug'),)}]
    assert read(phrase, 'go back to dark red cup') == [
        {'thing': (('colour', 'crimson'), ('class', 'mug'))}
    ]
    for text in ('go mug', 'back to mug', 'go to red', 'go to mug now', 'go to', ''):
        assert read(phrase, text) == []


@pytest.mark.parametrize(
    'text, slot, value',
    [
        ('two metres', 'distance', 2.0),
        ('half a meter', 'distance', 0.5),
        ('1.5 m', 'distance', 1.5),
        ('50 cm', 'distance', 0.5),
        ('a metre', 'distance', 1.0),
        ('three steps', 'distance', 0.9),
        ('two and a half metres', 'distance', 2.5),
        ('forty five degrees', 'angle', 45.0),
        ('one hundred and eighty degrees', 'angle', 180.0),
        ('a hundred twenty', 'angle', 120.0),
        ('three hundred and sixty degrees', 'angle', 360.0),
        ('two hundred', 'angle', 200.0),
        ('two hundred and a half degrees', 'angle', 200.5),
        ('two minutes', 'duration', 120.0),
        ('12', 'duration', 12.0),
    ],
)
def test_numbers(text: str, slot: str, value: float) -> None:
    """Numbers are digits or words, with a unit or without."""
    assert read(f'{{{slot}}}', text) == [{slot: pytest.approx(value)}]


@pytest.mark.parametrize(
    'text', ['two', 'metres two', 'two degrees', 'minus two metres', 'twelve hundred', 'hundred']
)
def test_what_is_no_distance(text: str) -> None:
    """A unit of something else does not count, and a number alone is one in metres."""
    assert read('{distance}', text) == ([{'distance': 2.0}] if text == 'two' else [])


def test_texts_are_as_short_as_possible_first() -> None:
    """What follows a free text is found."""
    assert read('say {text} [then go]', 'say hello then go')[0] == {'text': 'hello'}


@pytest.mark.parametrize(
    'phrase',
    [
        *('(a | b', 'a ]', '[a', '(a |)', '', '( )', 'a | '),
        *('(a | /0/ b)', '/./ a', 'a /2/ b', '(/2/)'),
    ],
)
def test_phrases_that_cannot_be_read(phrase: str) -> None:
    """The sentence quotes the phrase."""
    with pytest.raises(GrammarError, match='The phrase'):
        parse_phrase(phrase)


def test_a_slot_can_name_its_rule() -> None:
    """The value is bound to the name of the slot; rules of arguments do not replace it."""
    assert read('take {first:thing}', 'take red mug') == [
        {'first': (('colour', 'red'), ('class', 'mug'))}
    ]
    phrase = with_rules(parse_phrase('{a} to {b:class}'), {'a': 'thing', 'b': 'distance'})
    assert phrase == parse_phrase('{a:thing} to {b:class}')


def test_jsgf_for_speech_has_weights_and_likely_texts() -> None:
    """A weight belongs to an alternative that begins with its word; all texts can be typed."""
    grammar = Grammar(
        {
            'name': parse_phrase('[(the | my)] {class}'),
            'where': parse_phrase('(on | /0.1/ the side of) {class}'),
        },
        {'class': {'mug': 'mug', 'cup': 'mug', 'bin': 'bin'}},
        spoken={'class': ['mug', 'bin']},
        weights={'the': 20.0, 'bin': 0.5},
    )
    lines = grammar.to_jsgf('robot', '<name>', {}).splitlines()
    assert '<name> = [(/20/ the | my)] <class>;' in lines
    assert '<class> = mug | /0.5/ bin;' in lines
    assert '<where> = (on | /0.1/ the side of) <class>;' in lines
    assert any(grammar.matches(parse_phrase('{name}'), ['the', 'cup']))


def test_jsgf() -> None:
    """Lists become rules; what cannot be said beforehand is left out."""
    phrases = {
        'go': parse_phrase('go [,] to {thing}'),
        'say': parse_phrase('say {text}'),
        'no': parse_phrase('no {none}'),
        'move': parse_phrase('move [{none}] {distance}'),
    }
    text = GRAMMAR.to_jsgf('robot', '<go>', phrases)
    lines = text.splitlines()
    assert lines[:3] == ['#JSGF V1.0;', 'grammar robot;', 'public <command> = <go>;']
    assert '<go> = go to <thing>;' in lines
    assert '<thing> = [<colour>] <class>;' in lines
    assert '<colour> = red | dark red;' in lines
    assert '<move> = move <distance>;' in lines
    assert not any('<say>' in line or '<no>' in line or '<none>' in line for line in lines)
