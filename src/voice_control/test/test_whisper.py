# SPDX-License-Identifier: Apache-2.0
"""Whisper is used with models of this machine only, and servers may answer as they like."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
import json
from pathlib import Path
import sys
import threading
import time
from types import ModuleType, SimpleNamespace
from typing import Any
import zlib

import pytest
from voice_control.recognition import RecognizerError
from voice_control.whisper import FasterWhisper, NEEDED_FILES, TranscriptionServer, WhisperCpp

SOUND = b'\1\0' * 8000


# Models


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with the files of a model."""
    for name in (*NEEDED_FILES, 'vocabulary.txt'):
        (tmp_path / name).write_text('{}')
    return tmp_path


@pytest.mark.parametrize('missing', [*NEEDED_FILES, 'vocabulary.txt'])
def test_missing_files_are_named(folder: Path, missing: str) -> None:
    """The library would ask the network for them."""
    (folder / missing).unlink()
    with pytest.raises(RecognizerError, match=missing.replace('.', r'\.')):
        FasterWhisper(str(folder))


@pytest.mark.parametrize('make', [FasterWhisper, WhisperCpp])
@pytest.mark.parametrize(('path', 'reason'), [('', 'set model_path'), ('/no/where', 'not found')])
def test_no_model(make: Callable[[str], Any], path: str, reason: str) -> None:
    """The message says what is needed."""
    with pytest.raises(RecognizerError, match=reason):
        make(path)


def test_a_file_that_is_no_model(tmp_path: Path) -> None:
    """The library of whisper.cpp would end the process."""
    (tmp_path / 'model.bin').write_bytes(b'GIF89a')
    with pytest.raises(RecognizerError, match='is not a model in the ggml format'):
        WhisperCpp(str(tmp_path / 'model.bin'))


def test_libraries_that_are_not_installed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message says how to install them."""
    monkeypatch.setitem(sys.modules, 'faster_whisper', None)
    monkeypatch.setitem(sys.modules, 'pywhispercpp', None)
    monkeypatch.setitem(sys.modules, 'pywhispercpp.model', None)
    with pytest.raises(RecognizerError, match='install the Python package faster-whisper'):
        FasterWhisper(str(folder))
    (folder / 'ggml.bin').write_bytes(b'lmgg')
    with pytest.raises(RecognizerError, match='install the Python package pywhispercpp'):
        WhisperCpp(str(folder / 'ggml.bin'))


@pytest.mark.parametrize(
    ('segments', 'text', 'is_accepted'),
    [
        ([(' Go to the', -0.2, 0.1), (' kitchen.', -0.4, 0.1)], 'go to the kitchen', True),
        ([("What's on the desk?", -0.2, 0.1)], "what's on the desk", True),
        ([(' Thanks for watching!', -1.4, 0.9)], '', False),
        ([(' ... ', -0.1, 0.1)], '', False),
        ([(' turn left' * 40, -0.1, 0.1)], '', False),
        ([], '', False),
    ],
)
def test_what_whisper_hears(
    folder: Path, monkeypatch: pytest.MonkeyPatch,
    segments: list[tuple[str, float, float]], text: str, is_accepted: bool,
) -> None:  # fmt: skip
    """Words are taken, without punctuation, and what it makes up in silence is not."""
    made = [
        SimpleNamespace(
            text=each,
            avg_logprob=sure,
            no_speech_prob=silence,
            compression_ratio=len(each) / len(zlib.compress(each.encode())),
        )
        for each, sure, silence in segments
    ]
    replace_library(monkeypatch, lambda *sound, **options: (iter(made), None))
    recognition = FasterWhisper(str(folder)).recognize(SOUND)
    assert (recognition.text, recognition.is_accepted) == (text, is_accepted)


@pytest.fixture
def prompts(monkeypatch: pytest.MonkeyPatch) -> list[str | None]:
    """Return the prompts that Whisper gets."""
    told: list[str | None] = []

    def transcribe(*sound: Any, initial_prompt: str | None, **options: Any) -> Any:
        told.append(initial_prompt)
        return iter(()), None

    replace_library(monkeypatch, transcribe)
    return told


def test_whisper_expects_commands(folder: Path, prompts: list[str | None]) -> None:
    """It takes them for what was said before; without them it gets nothing of the kind."""
    whisper = FasterWhisper(str(folder))
    whisper.recognize(SOUND)
    whisper.expect(['go to the hall', 'stop'])
    whisper.recognize(SOUND)
    assert prompts == [None, 'Go to the hall. Stop.']
    whisper.expect(['go to the hall'] * 200)
    whisper.recognize(SOUND)
    assert 100 < len((prompts[-1] or '').split()) <= 150


def test_another_language_gets_no_commands(folder: Path, prompts: list[str | None]) -> None:
    """English before it, Whisper would write English."""
    whisper = FasterWhisper(str(folder), 'de')
    whisper.expect(['go to the hall'])
    whisper.recognize(SOUND)
    assert prompts == [None]


def replace_library(monkeypatch: pytest.MonkeyPatch, transcribe: Callable[..., Any]) -> None:
    """Put a function in the place of faster-whisper."""
    module = ModuleType('faster_whisper')
    model = SimpleNamespace(transcribe=transcribe)
    module.WhisperModel = lambda *path, **options: model  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, 'faster_whisper', module)


# Servers

Answer = tuple[int, bytes]


@contextmanager
def serving(answer: Callable[[Any, bytes], Answer]) -> Iterator[str]:
    """Run a server that answers a request as a function says; give its address."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers['Content-Length']))
            status, content = answer(self, body)
            self.send_response(status)
            self.send_header('Content-Length', str(len(content)))
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    server = ThreadingHTTPServer(('127.0.0.1', 0), Handler)
    server.daemon_threads = True
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    try:
        yield f'http://127.0.0.1:{server.server_port}/v1'
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


def test_a_server_gets_a_file() -> None:
    """With the key, the model and the language; its words are taken."""
    asked: list[tuple[str, str, bytes]] = []

    def answer(request: Any, body: bytes) -> Answer:
        asked.append((request.path, request.headers['Authorization'], body))
        return 200, json.dumps({'text': 'Go to the kitchen.'}).encode()

    with serving(answer) as url:
        server = TranscriptionServer(url, 'whisper-large', 'secret')
        server.expect(['go to the hall'])
        recognition = server.recognize(SOUND)
    assert (recognition.text, recognition.is_accepted) == ('go to the kitchen', True)
    [(path, authorization, body)] = asked
    assert (path, authorization) == ('/v1/audio/transcriptions', 'Bearer secret')
    assert b'whisper-large' in body and b'RIFF' in body and SOUND in body
    assert b'name="prompt"' in body and b'Go to the hall.' in body


@pytest.mark.parametrize(
    ('answer', 'reason'),
    [
        ((500, b'broken'), 'status 500'),
        ((401, b'{"error": "key"}'), 'status 401'),
        ((429, b''), 'status 429'),
        ((302, b''), 'status 302'),
        ((200, b'<html>'), 'did not answer with a text'),
        ((200, b'{"words": 1}'), 'did not answer with a text'),
        ((200, b'[]'), 'did not answer with a text'),
        ((200, b'\xff\xfe'), 'did not answer with a text'),
    ],
)
def test_a_server_that_answers_badly(answer: Answer, reason: str) -> None:
    """Each is one sentence, and the grammar can take over."""
    with serving(lambda request, body: answer) as url:
        with pytest.raises(RecognizerError, match=reason):
            TranscriptionServer(url, 'any').recognize(SOUND)


def test_a_server_that_does_not_answer() -> None:
    """It is waited for no longer than was said."""
    is_over = threading.Event()

    def answer(request: Any, body: bytes) -> Answer:
        is_over.wait(30.0)
        return 200, b'{}'

    with serving(answer) as url:
        began_s = time.monotonic()
        with pytest.raises(RecognizerError, match='does not answer'):
            TranscriptionServer(url, 'any', timeout_s=0.3).recognize(SOUND)
        assert time.monotonic() - began_s < 20.0
        is_over.set()
    with pytest.raises(RecognizerError, match='does not answer'):
        TranscriptionServer(url, 'any').recognize(SOUND)


@pytest.mark.parametrize('url', ['', 'localhost:8000', 'ftp://here'])
def test_no_address(url: str) -> None:
    """The message says what one looks like."""
    with pytest.raises(RecognizerError, match='not a valid server address'):
        TranscriptionServer(url, 'any')
