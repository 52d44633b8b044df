# SPDX-License-Identifier: Apache-2.0
"""Commands are recognized by their grammar, and other speech is rejected."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from voice_control.audio import chunks, read_wav
from voice_control.grammar_recognizer import (
    GrammarRecognizer,
    read_dictionary,
)
from voice_control.noise_suppression import NoiseSuppressor
from voice_control.recognition import RecognizerError
from voice_control.segmentation import UtteranceSegmenter

SPEECH = Path(__file__).parent / 'speech'
GRAMMAR = (SPEECH / 'robot.jsgf').read_text()
SAID = sorted(SPEECH.glob('*.wav'))
OTHER = 'other_'
"""How the names of files begin whose words are no command."""


def utterances(sound: bytes, chunk_s: float = 0.03) -> list[bytes]:
    """Return the utterances of a sound with silence around it."""
    segmenter = UtteranceSegmenter()
    found = [
        utterance
        for chunk in chunks(bytes(16_000) + sound + bytes(32_000), chunk_s)
        for utterance in segmenter.add(chunk)
    ]
    return [*found, *segmenter.finish()]


def in_noise(path: Path, level: float) -> bytes:
    """Return the utterance in a file, with white noise of a standard deviation."""
    samples = np.frombuffer(bytes(16_000) + read_wav(path) + bytes(32_000), '<i2')
    noise = np.random.default_rng(2).normal(0.0, level, samples.size)
    [utterance] = UtteranceSegmenter().add((samples + noise).astype('<i2').tobytes())
    return utterance


def text_of(path: Path) -> str:
    """Return what is said in a file."""
    return path.name.partition('.')[0].replace('_', ' ')


@pytest.fixture(scope='module')
def recognizer() -> GrammarRecognizer:
    """Return a recogniser with the commands of the robot."""
    made = GrammarRecognizer()
    assert made.set_grammar(GRAMMAR) == []
    return made


@pytest.mark.parametrize(
    'path', [path for path in SAID if not path.name.startswith(OTHER)], ids=lambda path: path.stem
)
def test_commands_are_recognized(recognizer: GrammarRecognizer, path: Path) -> None:
    """The voices of several synthesizers say them."""
    [utterance] = utterances(read_wav(path))
    recognition = recognizer.recognize(utterance)
    assert recognition.is_accepted, recognition
    assert recognition.is_stop == text_of(path).startswith('stop')
    if not recognition.is_stop:  # "stop it" is as good as "stop"
        assert recognition.text == text_of(path)


@pytest.mark.parametrize(
    'path', [path for path in SAID if path.name.startswith(OTHER)], ids=lambda path: path.stem
)
def test_other_sentences_are_rejected(recognizer: GrammarRecognizer, path: Path) -> None:
    """Though the grammar finds words in them; the reason quotes those."""
    [utterance] = utterances(read_wav(path))
    recognition = recognizer.recognize(utterance)
    assert not recognition.is_accepted and not recognition.is_stop
    assert recognition.reason


def test_there_are_commands_and_others() -> None:
    """So that the two tests above test something."""
    others = [path for path in SAID if path.name.startswith(OTHER)]
    assert len(others) >= 3 and len(SAID) - len(others) >= 6


def test_noise_is_no_command(recognizer: GrammarRecognizer) -> None:
    """Two seconds of hiss are not accepted."""
    chance = np.random.default_rng(1)
    hiss = chance.normal(0.0, 800.0, 32_000).astype('<i2').tobytes()
    recognition = recognizer.recognize(hiss)
    assert not recognition.is_accepted or recognition.is_stop


def test_words_without_pronunciation_cannot_be_said() -> None:
    """They are named; what can be said without them is recognized."""
    made = GrammarRecognizer()
    grammar = GRAMMAR.replace('kitchen |', 'kitchen | xyzzyqux | big xyzzyqux |', 1)
    assert made.set_grammar(grammar) == ['xyzzyqux']
    [utterance] = utterances(read_wav(SPEECH / 'go_to_the_kitchen.slt.wav'))
    assert made.recognize(utterance).text == 'go to the kitchen'


def test_compounds_are_pronounced_as_their_halves() -> None:
    """There is no sideboard in CMUdict; a word of which only one half is known cannot be said."""
    made = GrammarRecognizer()
    grammar = '#JSGF V1.0; grammar g; public <c> = how many books are on the (%s | desk);'
    assert made.set_grammar(grammar % 'sideboard') == []
    [utterance] = utterances(read_wav(SPEECH / 'how_many_books_are_on_the_sideboard.slt.wav'))
    assert made.recognize(utterance).text == 'how many books are on the sideboard'
    assert made.set_grammar(grammar % 'sidexyzzy') == ['sidexyzzy']


@pytest.mark.parametrize('likelier', ['two', 'too'])
def test_weights_decide_between_words_that_sound_the_same(likelier: str) -> None:
    """The likelier one is recognized."""
    made = GrammarRecognizer()
    words = ' | '.join(f'/{100 if word == likelier else 1}/ {word}' for word in ('two', 'too'))
    assert made.set_grammar(f'#JSGF V1.0; grammar g; public <c> = go ({words}) the kitchen;') == []
    [utterance] = utterances(read_wav(SPEECH / 'go_to_the_kitchen.slt.wav'))
    assert made.recognize(utterance).text == f'go {likelier} the kitchen'


def test_a_dictionary_adds_words() -> None:
    """What it has can be said."""
    made = GrammarRecognizer(dictionary={'kitshen': 'K IH CH AH N'})
    grammar = '#JSGF V1.0; grammar g; public <c> = go to the (kitshen | hall);'
    assert made.set_grammar(grammar) == []
    [utterance] = utterances(read_wav(SPEECH / 'go_to_the_kitchen.slt.wav'))
    assert made.recognize(utterance).text == 'go to the kitshen'


@pytest.mark.parametrize(
    'grammar',
    ['', 'nonsense', '#JSGF V1.0; grammar x; public <a> = (b;', '#JSGF V1.0; grammar x;'],
)
def test_what_is_no_grammar_changes_nothing(grammar: str) -> None:
    """The commands of before are recognized."""
    made = GrammarRecognizer()
    made.set_grammar(GRAMMAR)
    with pytest.raises(RecognizerError, match='cannot be used'):
        made.set_grammar(grammar)
    [utterance] = utterances(read_wav(SPEECH / 'go_to_the_kitchen.slt.wav'))
    assert made.recognize(utterance).text == 'go to the kitchen'


def test_before_a_grammar_comes_stop_is_heard() -> None:
    """And nothing else is taken for it, or accepted."""
    made = GrammarRecognizer()
    for path in sorted(SPEECH.glob('*.wav')):
        [utterance] = utterances(read_wav(path))
        recognition = made.recognize(utterance)
        assert recognition.is_stop == path.name.startswith('stop'), path.name
        if not recognition.is_stop:
            assert (recognition.is_accepted, recognition.text) == (False, '')
            assert recognition.reason.startswith('Only "stop" is recognized as long as')


def test_a_dictionary_is_read() -> None:
    """As CMUdict writes it, with comments."""
    lines = ['# comment', '', 'Nao N AW', 'mug M AH G  # again']
    assert read_dictionary(lines) == {'nao': 'N AW', 'mug': 'M AH G'}
    with pytest.raises(RecognizerError, match="Line 2 of the dictionary, 'robot',"):
        read_dictionary(['nao N AW', 'robot'])


@pytest.mark.parametrize('noise', [10.0, 200.0])
@pytest.mark.parametrize(
    'path',
    [path for path in SAID if text_of(path) == 'stop'],
    ids=lambda path: path.stem,
)
def test_a_short_stop_is_heard_in_noise(path: Path, noise: float) -> None:
    """Also as the first thing that is heard, at a signal-to-noise ratio of some 20 dB."""
    made = GrammarRecognizer(suppress=NoiseSuppressor().suppress)
    made.set_grammar(GRAMMAR)
    recognition = made.recognize(in_noise(path, noise))
    assert recognition.is_stop, recognition


@pytest.mark.parametrize('noise', [10.0, 200.0])
@pytest.mark.parametrize(
    'path', [path for path in SAID if path.name.startswith(OTHER)], ids=lambda path: path.stem
)
def test_other_sentences_do_not_stop_the_robot(path: Path, noise: float) -> None:
    """A stop has to sound like one, also in noise, and before there is a grammar."""
    made = GrammarRecognizer(suppress=NoiseSuppressor().suppress)
    assert not made.recognize(in_noise(path, noise)).is_stop
    made.set_grammar(GRAMMAR)
    assert not made.recognize(in_noise(path, noise)).is_stop


def test_a_command_in_noise_is_sought_without_it() -> None:
    """At a signal-to-noise ratio of some 20 dB, at which it is not recognized otherwise."""
    utterance = in_noise(SPEECH / 'go_to_the_kitchen.awb.wav', 200.0)
    texts = []
    for suppress in (None, NoiseSuppressor().suppress):
        made = GrammarRecognizer(suppress=suppress)
        made.set_grammar(GRAMMAR)
        recognition = made.recognize(utterance)
        texts.append(recognition.text if recognition.is_accepted else '')
    assert texts == ['', 'go to the kitchen']


@pytest.mark.parametrize(
    ('name', 'noise', 'count'),
    [
        ('go_to_the_kitchen.rms', 0.0, 0),
        ('stop.awb', 200.0, 0),
        ('go_to_the_kitchen.awb', 200.0, 1),
    ],
)
def test_what_is_clear_and_a_clear_stop_need_no_suppression(
    name: str, noise: float, count: int
) -> None:
    """Suppression takes time, and may take a short word for noise."""
    asked = []

    def suppress(sound: bytes) -> bytes:
        asked.append(sound)
        return bytes(len(sound))

    made = GrammarRecognizer(suppress=suppress)
    made.set_grammar(GRAMMAR)
    recognition = made.recognize(in_noise(SPEECH / f'{name}.wav', noise))
    assert len(asked) == count
    assert recognition.is_accepted == (count == 0)


@pytest.mark.parametrize('chunk_s', [0.01, 0.037, 1.0])
def test_pieces_of_any_length_make_the_same_utterances(chunk_s: float) -> None:
    """Two sentences with a pause between them are two utterances."""
    first, second = (
        read_wav(SPEECH / f'{name}.slt.wav') for name in ('go_to_the_kitchen', 'stop')
    )
    found = utterances(first + bytes(32_000) + second, chunk_s)
    assert [len(each) for each in found] == [
        len(each) for each in utterances(first + bytes(32_000) + second)
    ]
    assert len(found) == 2


def test_silence_is_no_utterance() -> None:
    """Digital silence either."""
    assert utterances(bytes(64_000)) == []


def test_what_does_not_end_is_cut() -> None:
    """An utterance has a greatest length."""
    segmenter = UtteranceSegmenter(longest_s=1.0)
    sentence = read_wav(SPEECH / 'go_to_the_kitchen.slt.wav')
    lengths = [len(each) / 32_000 for each in segmenter.add(sentence * 4)]
    assert len(lengths) > 2 and max(lengths) < 1.5
