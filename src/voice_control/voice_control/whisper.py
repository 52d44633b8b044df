# SPDX-License-Identifier: Apache-2.0
"""
Recognize free speech with Whisper: with faster-whisper, whisper.cpp or a server.

The user provides the libraries and their models: nothing is ever downloaded.
"""

from __future__ import annotations

from collections.abc import Sequence
import math
import os
from pathlib import Path
import re
from typing import Any

from humanoid_common.paths import expanded_path
import numpy as np
from numpy.typing import NDArray
from voice_control.audio import wav_of
from voice_control.recognition import Recognition, RecognizerError

__all__ = ['FasterWhisper', 'TranscriptionServer', 'WhisperCpp']

NEEDED_FILES = ('model.bin', 'config.json', 'tokenizer.json')
VOCABULARIES = ('vocabulary.json', 'vocabulary.txt')
GGML_MAGIC = b'lmgg'
_SILENCE_PROBABILITY = 0.6
_UNSURE = -1.0
_LANGUAGE_OF_COMMANDS = 'en'
_PROMPT_WORDS = 150
"""Whisper reads the last 223 tokens of a prompt, about 1.3 per word with the full stops."""
_REPEATS = 2.4
"""Compression ratio above which a text is no speech: Whisper has started to repeat itself."""
_MOST_TOKENS = 100
"""Maximum number of tokens of an utterance: no one says more in ten seconds."""
_NO_SPEECH = 'Nothing was said.'
_REPETITION = 'Whisper repeated itself, so the result is unusable.'
_PUNCTUATION = re.compile(r"[^\w\s'°%-]")


class FasterWhisper:
    """
    Whisper recogniser that uses the library faster-whisper.

    Parameters
    ----------
    folder
        A model in the format of CTranslate2.
    language
        The language that is spoken, such as `en`.
    threads
        The number of CPU threads.

    Raises
    ------
    RecognizerError
        If the library is not installed, or files are missing.

    """

    def __init__(self, folder: str, language: str = 'en', threads: int = 1) -> None:
        path = _existing(folder, 'faster-whisper', 'a folder with a model')
        missing = [name for name in NEEDED_FILES if not (path / name).is_file()]
        if not any((path / name).is_file() for name in VOCABULARIES):
            missing.append(' or '.join(VOCABULARIES))
        if missing:
            raise RecognizerError(
                f"'{path}' is not a faster-whisper model: it lacks {', '.join(missing)}."
            )
        os.environ['HF_HUB_OFFLINE'] = '1'  # else it tries for minutes to fetch missing files
        try:
            from faster_whisper import WhisperModel
        except ImportError as error:
            raise _not_installed('faster-whisper', error) from error
        try:
            self._model = WhisperModel(
                str(path), device='cpu', compute_type='int8', cpu_threads=threads
            )
        except (RuntimeError, ValueError, OSError) as error:
            raise RecognizerError(f"The model in '{path}' cannot be used: {error}") from error
        self._language = language
        self._prompt = ''
        self.title = f"Whisper (faster-whisper, '{path}')"

    def expect(self, examples: Sequence[str]) -> None:
        """
        Set commands as the prompt of Whisper, as if it had just heard them.

        Parameters
        ----------
        examples : Sequence[str]
            English commands, of which about 150 words are used; no effect in another language.

        """
        self._prompt = _prompt(examples, self._language)

    def recognize(self, sound: bytes) -> Recognition:
        """
        Recognize an utterance with faster-whisper.

        Parameters
        ----------
        sound
            As for `Recognizer.recognize`.

        Returns
        -------
        Recognition
            Its confidence is the mean log-probability per token of the worst segment.

        """
        segments = list(
            self._model.transcribe(
                _samples(sound),
                language=self._language,
                beam_size=1,
                temperature=0.0,
                condition_on_previous_text=False,
                without_timestamps=True,
                initial_prompt=self._prompt or None,
                max_new_tokens=_MOST_TOKENS,
            )[0]
        )
        if not segments:
            return Recognition('', -math.inf, 'whisper', _NO_SPEECH)
        if max(each.compression_ratio for each in segments) > _REPEATS:
            return Recognition('', -math.inf, 'whisper', _REPETITION)
        confidence = min(each.avg_logprob for each in segments)
        silence = max(each.no_speech_prob for each in segments)
        return _judged(''.join(each.text for each in segments), confidence, silence, 'whisper')


class WhisperCpp:
    """
    Whisper recogniser that uses the library pywhispercpp.

    Parameters
    ----------
    file
        A model in the ggml format.
    language, threads
        As for `FasterWhisper`.

    Raises
    ------
    RecognizerError
        If the library is not installed, or the file is no model. The library itself would crash
        the process with a segmentation fault.

    """

    def __init__(self, file: str, language: str = 'en', threads: int = 1) -> None:
        path = _existing(file, 'whisper.cpp', 'a file in the ggml format')
        with path.open('rb') as content:
            magic = content.read(len(GGML_MAGIC))
        if magic != GGML_MAGIC:
            raise RecognizerError(
                f"'{path}' is not a model in the ggml format, which whisper.cpp needs."
            )
        try:
            from pywhispercpp.model import Model
        except ImportError as error:
            raise _not_installed('pywhispercpp', error) from error
        self._model: Any = Model(
            str(path), n_threads=threads, language=language, print_progress=False,
            print_realtime=False, redirect_whispercpp_logs_to=None,
        )  # fmt: skip
        self.title = f"Whisper (whisper.cpp, '{path}')"

    def expect(self, examples: Sequence[str]) -> None:
        """
        Ignore the examples: with a prompt, pywhispercpp has crashed the process (its issue 141).

        Parameters
        ----------
        examples : Sequence[str]
            Ignored.

        """

    def recognize(self, sound: bytes) -> Recognition:
        """
        Recognize an utterance with whisper.cpp.

        Parameters
        ----------
        sound
            As for `Recognizer.recognize`.

        Returns
        -------
        Recognition
            Its confidence is not known: NaN.

        """
        segments = self._model.transcribe(_samples(sound), no_context=True, temperature=0.0)
        text = ''.join(str(each.text) for each in segments)
        return _judged(text, math.nan, 0.0, 'whisper_cpp')


class TranscriptionServer:
    """
    Client of a server with an OpenAI-compatible API: `POST base_url/audio/transcriptions`.

    Parameters
    ----------
    base_url
        The base URL of the API, such as `http://127.0.0.1:8000/v1`.
    model
        The name of the model on the server.
    key
        The API key, if the server requires one.
    language
        As for `FasterWhisper`.
    timeout_s
        The time limit for a response.

    """

    def __init__(
        self, base_url: str, model: str, key: str = '', language: str = 'en',
        timeout_s: float = 15.0,
    ) -> None:  # fmt: skip
        import httpx

        if not base_url.startswith(('http://', 'https://')):
            raise RecognizerError(
                f"'{base_url}' is not a valid server address: set base_url, for example to "
                'http://127.0.0.1:8000/v1.'
            )
        self._url = f'{base_url.rstrip("/")}/audio/transcriptions'
        self._form = {'model': model, 'language': language, 'response_format': 'json'}
        headers = {'Authorization': f'Bearer {key}'} if key else {}
        self._client = httpx.Client(headers=headers, timeout=timeout_s)
        self.title = f'the server at {self._url}'

    def expect(self, examples: Sequence[str]) -> None:
        """
        Set commands as the prompt that is sent along with each utterance.

        Parameters
        ----------
        examples : Sequence[str]
            As for `FasterWhisper.expect`.

        """
        self._form['prompt'] = _prompt(examples, self._form['language'])

    def recognize(self, sound: bytes) -> Recognition:
        """
        Recognize an utterance with the server.

        Parameters
        ----------
        sound
            As for `Recognizer.recognize`.

        Returns
        -------
        Recognition
            Its confidence is not known: NaN.

        Raises
        ------
        RecognizerError
            If the server does not respond, or responds with an error or without a text.

        """
        import httpx

        files = {'file': ('speech.wav', wav_of(sound), 'audio/wav')}
        try:
            answer = self._client.post(self._url, data=self._form, files=files)
        except httpx.HTTPError as error:
            why = str(error) or type(error).__name__
            raise RecognizerError(f'The server at {self._url} does not answer: {why}.') from error
        if answer.status_code != httpx.codes.OK:
            raise RecognizerError(
                f'The server at {self._url} failed with status {answer.status_code}: '
                f'{answer.text[:200]!r}.'
            )
        try:
            text = answer.json()['text']
        except (ValueError, KeyError, TypeError) as error:
            raise RecognizerError(
                f'The server at {self._url} did not answer with a text: {answer.text[:200]!r}.'
            ) from error
        return _judged(str(text), math.nan, 0.0, 'openai')


def _existing(path: str, library: str, what: str) -> Path:
    if not path:
        raise RecognizerError(f'{library} needs {what}: set model_path.')
    found = expanded_path(path)
    if not found.exists():
        raise RecognizerError(f"'{found}' not found: {library} needs {what}.")
    return found


def _not_installed(library: str, error: ImportError) -> RecognizerError:
    return RecognizerError(
        f'{library} cannot be imported ({error}): install the Python package {library}.'
    )


def _prompt(examples: Sequence[str], language: str) -> str:
    """
    Format commands as a prompt, in the style of Whisper, up to the length that it reads.

    They are English: for another language there is no prompt, since Whisper continues in the
    language of the prompt.
    """
    prompt = ''
    if language != _LANGUAGE_OF_COMMANDS:
        return prompt
    for example in examples:
        longer = f'{prompt} {example.capitalize()}.'.strip()
        if len(longer.split()) > _PROMPT_WORDS:
            break
        prompt = longer
    return prompt


def _samples(sound: bytes) -> NDArray[np.float32]:
    return np.frombuffer(sound, '<i2').astype(np.float32) / 32768.0


def _judged(text: str, confidence: float, silence: float, backend: str) -> Recognition:
    """Build a recognition from a text; reject what a model hallucinates in silence."""
    words = ' '.join(_PUNCTUATION.sub(' ', text.lower()).split())
    if not words or (silence > _SILENCE_PROBABILITY and confidence < _UNSURE):
        return Recognition('', confidence, backend, _NO_SPEECH)
    return Recognition(words, confidence, backend)
