# SPDX-License-Identifier: Apache-2.0
"""The word stop is always heard, and everything else by the recogniser that was chosen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import pytest
from voice_control.recognition import Listener, Recognition, RecognizerError


@dataclass
class Scripted:
    """A recogniser that hears what it is told to."""

    text: str
    is_stop: bool = False
    reason: str = ''
    title: str = 'scripted'
    asked: list[bytes] = field(default_factory=list)
    expected: list[str] = field(default_factory=list)

    def set_grammar(self, jsgf: str) -> list[str]:
        """Take the grammar for a text to hear."""
        self.text = jsgf
        return ['xyzzy']

    def accepts(self, text: str) -> bool:
        """Return whether that is the text."""
        return text == self.text

    @property
    def examples(self) -> Sequence[str]:
        """Return the text."""
        return [self.text]

    def expect(self, examples: Sequence[str]) -> None:
        """Keep what is likely."""
        self.expected += examples

    def recognize(self, sound: bytes) -> Recognition:
        """Return the text, or fail if it is `fail`."""
        self.asked.append(sound)
        if self.text == 'fail':
            raise RecognizerError('It is broken.')
        return Recognition(self.text, 0.0, self.title, self.reason, self.is_stop)


SOUND = bytes(64_000)


def test_the_grammar_alone() -> None:
    """It hears everything if there is no other recogniser; the length of the sound is told."""
    heard = Listener(Scripted('go to the hall')).hear(SOUND)
    assert heard.recognition.text == 'go to the hall'
    assert heard.recognition.is_accepted
    assert heard.speech_s == 2.0


def test_it_is_ready_for_more_than_stop_once_there_is_a_grammar() -> None:
    """A recogniser of free speech needs none."""
    listener = Listener(Scripted('go to the hall'))
    assert not listener.is_ready
    listener.set_grammar('go to the desk')
    assert listener.is_ready
    assert Listener(Scripted('go to the hall'), Scripted('good morning')).is_ready


def test_stop_does_not_wait_for_the_other_recogniser() -> None:
    """The grammar decides."""
    other = Scripted('a slow one')
    heard = Listener(Scripted('stop', is_stop=True), other).hear(SOUND)
    assert heard.recognition.text == 'stop'
    assert other.asked == []


def test_the_other_recogniser_hears_the_rest() -> None:
    """It gets the same sound."""
    other = Scripted('good morning')
    heard = Listener(Scripted('go', reason='It did not sound like it.'), other).hear(SOUND)
    assert heard.recognition.text == 'good morning'
    assert other.asked == [SOUND]


@pytest.mark.parametrize(
    ('command', 'reason', 'free', 'expected'),
    [
        ('go to the hall', '', 'go to the hole', 'go to the hall'),
        ('go to the hall', 'It did not sound like it.', 'go to the hole', 'go to the hole'),
        ('go to the hall', '', 'good morning', 'good morning'),
        ('go to the hall', '', '', ''),
    ],
)
def test_words_that_are_nearly_a_command(
    command: str, reason: str, free: str, expected: str
) -> None:
    """The command counts if the grammar's recogniser accepts it."""
    listener = Listener(Scripted(command, reason=reason), Scripted(free))
    assert listener.hear(SOUND).recognition.text == expected


def test_the_other_recogniser_gets_examples() -> None:
    """Of each grammar; the words that cannot be heard are returned."""
    other = Scripted('anything')
    assert Listener(Scripted('stop'), other).set_grammar('go to the hall') == ['xyzzy']
    assert other.expected == ['go to the hall']
    assert Listener(Scripted('stop')).set_grammar('go to the hall') == ['xyzzy']


def test_a_recogniser_that_fails() -> None:
    """The grammar takes its place, and somebody is told."""
    told: list[str] = []
    listener = Listener(Scripted('go to the hall'), Scripted('fail'), report=told.append)
    assert listener.hear(SOUND).recognition.text == 'go to the hall'
    assert told == ['It is broken. The grammar is used instead.']


@pytest.mark.parametrize(
    ('text', 'is_stop', 'expected'),
    [
        ('hey robot, go to the hall', False, 'go to the hall'),
        ('hey robot go', False, 'go'),
        ('go to the hall', False, None),
        ('stop', True, 'stop'),
        ('hey', False, None),
    ],
)
def test_wake_word(text: str, is_stop: bool, expected: str | None) -> None:
    """What does not begin with it is rejected, but for "stop"."""
    listener = Listener(Scripted(text, is_stop), wake_word='Hey Robot')
    recognition = listener.hear(SOUND).recognition
    assert recognition.is_accepted == (expected is not None)
    if expected is not None:
        assert recognition.text == expected
    else:
        assert recognition.reason == 'It did not start with "hey robot".'
