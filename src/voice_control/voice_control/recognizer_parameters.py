# SPDX-License-Identifier: Apache-2.0
"""Parameters of the node `speech_recognizer`, which can be read without its libraries."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter

__all__ = ['THRESHOLD', 'RecognizerParameters']

POCKETSPHINX, WHISPER, WHISPER_CPP, OPENAI = 'pocketsphinx', 'whisper', 'whisper_cpp', 'openai'
THRESHOLD = -1.0
"""The default minimum log-likelihood ratio per frame of a command."""


@dataclass(frozen=True)
class RecognizerParameters:
    """The parameters of the node."""

    backend: str = parameter(
        POCKETSPHINX,
        'What recognizes speech: the grammar of commands (pocketsphinx), Whisper by '
        'faster-whisper or whisper.cpp, or a server. The grammar hears "stop" in any case.',
        choices=(POCKETSPHINX, WHISPER, WHISPER_CPP, OPENAI),
        read_only=True,
    )
    model_path: str = parameter(
        '', 'The folder or file of the Whisper model on this machine.', read_only=True
    )
    base_url: str = parameter(
        '', 'The base URL of the server, for the backend openai.', read_only=True
    )
    model: str = parameter('', 'The model that the server should use.', read_only=True)
    language: str = parameter(
        'en', 'The language that Whisper or the server should expect.', read_only=True
    )
    num_threads: int = parameter(
        1, 'The number of threads that Whisper uses.', at_least=1, at_most=64, read_only=True
    )
    threshold: float = parameter(
        THRESHOLD,
        'The minimum log-likelihood ratio per frame for pocketsphinx to accept a command.',
        at_least=-100.0,
        at_most=100.0,
        read_only=True,
    )
    dictionary_file: str = parameter(
        '',
        'A dictionary file: words that pocketsphinx does not know, each with its phones.',
        read_only=True,
    )
    wake_word: str = parameter(
        '',
        'The wake word that commands have to start with; empty to accept every command.',
        read_only=True,
    )
    noise_suppression: bool = parameter(
        True,
        'Whether pocketsphinx removes steady noise before it seeks commands in a noisy utterance.',
        read_only=True,
    )
    vad_mode: int = parameter(
        0,
        'How aggressively sound that is not speech is filtered out.',
        at_least=0,
        at_most=3,
        read_only=True,
    )
    max_utterance_s: float = parameter(
        10.0, 'The maximum length of an utterance (s).', at_least=1.0, at_most=60.0, read_only=True
    )
