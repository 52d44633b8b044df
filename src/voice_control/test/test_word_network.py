# SPDX-License-Identifier: Apache-2.0
"""Grammars in JSGF become the smallest networks of words that accept the same sentences."""

from __future__ import annotations

from pathlib import Path

import pytest
from voice_control.jsgf import compile_jsgf
from voice_control.recognition import RecognizerError

HEAD = '#JSGF V1.0;\ngrammar robot;\n'
GRAMMAR = (Path(__file__).parent / 'speech' / 'robot.jsgf').read_text()


@pytest.mark.parametrize(
    ('rule', 'accepted', 'rejected'),
    [
        ('go (left | right)', ['go left', 'go right'], ['go', 'go left right', 'left']),
        ('go [now]', ['go', 'go now'], ['now', 'go now now']),
        ('(a | b)* c', ['c', 'a c', 'a b b a c'], ['a', '']),
        ('(a b)+', ['a b', 'a b a b'], ['', 'a', 'a b a']),
        ('"two words" a', ['two words a'], ['two a']),
        ('a <NULL> b', ['a b'], ['a']),
        ('a | b <VOID>', ['a'], ['b', 'a b']),
        ('/0.5/ a {tag} | /2/ b { t\\}ag }', ['a', 'b'], ['tag', 'a tag']),
        ('<x> and <x>', ['one and two', 'two and two'], ['one', 'and']),
    ],
)
def test_what_can_be_said(rule: str, accepted: list[str], rejected: list[str]) -> None:
    """Alternatives, options, repetitions, references, weights and tags mean what JSGF says."""
    network = compile_jsgf(f'{HEAD}public <c> = {rule}; // comment\n/* <x> */ <x> = one | two;')
    assert [text for text in accepted if not network.accepts(text)] == []
    assert [text for text in rejected if network.accepts(text)] == []


def test_unknown_words_are_left_out() -> None:
    """With them goes what cannot be said without them, and nothing else."""
    grammar = HEAD + 'public <c> = go to the (big xyzzy | hall | <p>) | find xyzzy; <p> = xyzzy;'
    network = compile_jsgf(grammar, lambda word: word != 'xyzzy')
    assert network.unknown == ('xyzzy',)
    assert network.accepts('go to the hall')
    assert not network.accepts('go to the xyzzy')
    assert {word for arcs in network.arcs for word in arcs} == {'go', 'to', 'the', 'hall'}


@pytest.mark.parametrize(
    ('rule', 'words', 'expected'),
    [
        ('/3/ a | b', '', {'a': 3.0, 'b': 1.0}),
        ('x (/4/ <p> | c)', 'x', {'one': 4.0, 'two': 8.0, 'c': 1.0}),
        ('x (a | /0.1/ <NULL>) b', 'x', {'a': 1.0, 'b': 0.1}),
        ('x (/2/ a b | /5/ a c)', 'x', {'a': 5.0}),
        ('x (/2/ a | b)*', 'x a', {'a': 2.0, 'b': 1.0, '': 1.0}),
        ('x (/2/ a b | c) | y (a b | c)', 'x', {'a': 2.0, 'c': 1.0}),
        ('x (/2/ a b | c) | y (a b | c)', 'y', {'a': 1.0, 'c': 1.0}),
    ],
)
def test_weights(rule: str, words: str, expected: dict[str, float]) -> None:
    """A weight belongs to the first words of its alternative, the largest one counts."""
    grammar = f'{HEAD}public <c> = {rule}; <p> = one | /2/ two;'
    network = compile_jsgf(grammar)
    state = 0
    for word in words.split():
        state = network.arcs[state][word]
    end = {'': network.ends[state]} if state in network.finals else {}
    assert {**network.weights[state], **end} == pytest.approx(expected)


def test_equal_ends_are_shared() -> None:
    """The object of sixty commands stands in the network once."""
    verbs = ' | '.join(f'verb{number} the <object>' for number in range(60))
    network = compile_jsgf(f'{HEAD}public <c> = {verbs}; <object> = red mug | blue mug | bowl;')
    assert len(network.arcs) == 5
    assert network.accepts('verb59 the blue mug')


def test_the_commands_of_the_robot() -> None:
    """The network is small, and has the sentences of the robot."""
    network = compile_jsgf(GRAMMAR)
    assert len(network.arcs) < 1000
    assert network.accepts('go to the kitchen find the red mug and tell me what stands beside it')
    assert not network.accepts('go to the kitchen and')


@pytest.mark.parametrize(
    ('grammar', 'reason'),
    [
        ('', 'has to start with'),
        ('nonsense', 'has to start with'),
        (f'{HEAD}<a> = b;', 'no public rule'),
        (f'{HEAD}public <a> = (b;', 'is not closed'),
        (f'{HEAD}public <a> = b);', 'unmatched'),
        (f'{HEAD}public <a> = b | ;', 'is empty'),
        (f'{HEAD}public <a> = b', 'has no end'),
        (f'{HEAD}public a = b;', 'is not a rule'),
        (f'{HEAD}public <a> = * b;', 'out of place'),
        (f'{HEAD}public <a> = <b>;', 'not defined'),
        (f'{HEAD}public <a> = b <c>; <c> = d [<a>];', 'refers to itself'),
        (f'{HEAD}import <other.*>; public <a> = b;', 'is not a rule'),
        (f'{HEAD}public <a> = <VOID>;', 'accepts no sentence'),
        (f'{HEAD}public <a> = /0/ b | c;', 'not a positive number'),
        (f'{HEAD}public <a> = b /2/ | c;', 'out of place'),
    ],
)
def test_what_is_no_grammar(grammar: str, reason: str) -> None:
    """A sentence says what is wrong."""
    with pytest.raises(RecognizerError, match=reason):
        compile_jsgf(grammar)


def test_examples() -> None:
    """Those of documentation comments are taken, if they can be said; others are comments."""
    documentation = '/** Moves.\n * @example go  left\n * @see x\n * @example go\n */\n'
    comment = '/* @example go right */ // @example go right\n'
    network = compile_jsgf(f'{HEAD}{documentation}{comment}public <c> = go (left | right);')
    assert network.shown == ('go left',)
    assert compile_jsgf(f'{HEAD}public <c> = go;').shown == ()
