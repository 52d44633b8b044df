# SPDX-License-Identifier: Apache-2.0
"""Segment an audio stream into utterances."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from pocketsphinx import Vad
from voice_control.audio import duration_s

__all__ = ['UtteranceSegmenter']

_BEGIN_S, _BEGIN_WITHIN_S = 0.21, 0.3
"""
Speech of this length within this time starts an utterance: a short "stop" has no more, and a new
detector classifies the first 0.18 s as speech in any case.
"""
_AROUND_S = 0.03
"""Silence that is kept before and after an utterance: with more, commands fit worse."""
_PAUSE_S = 0.45
"""Silence of this length ends an utterance; the pause at a comma is shorter."""
_CLICKS = 1
"""Number of frames of a pause that may be classified as speech."""
_NOISE = 3.0
"""Standard deviation of the added noise, in steps of 16-bit samples."""


@dataclass
class UtteranceSegmenter:
    """
    Segmenter of an audio stream by the voice activity detector (VAD) of pocketsphinx.

    pocketsphinx's own `Endpointer` has one window for the start and the end of speech: with one
    that is long enough for a pause, a short "stop" does not start an utterance.

    Faint noise is added to the input: the cepstral mean, by which recognisers normalize audio, is
    useless after digital silence.

    Parameters
    ----------
    vad_mode
        The aggressiveness with which the VAD rejects non-speech: 0 to 3.
    longest_s
        The maximum length of an utterance, after which it is cut.

    """

    vad_mode: int = 0
    longest_s: float = 10.0

    def __post_init__(self) -> None:
        self._chance = np.random.default_rng(0)
        self._vad = Vad(self.vad_mode)
        self._frame_size = int(self._vad.frame_bytes)
        self._frame_s = float(self._vad.frame_length)
        self.reset()

    def reset(self) -> None:
        """Discard the buffered audio, to start with a new stream."""
        self._rest = b''
        self._speech = b''
        window = self._frames(_BEGIN_WITHIN_S)
        self._begin = deque[bool](maxlen=window)
        self._before = deque[bytes](maxlen=window + self._frames(_AROUND_S))
        self._end = deque[bool](maxlen=self._frames(_PAUSE_S))

    def add(self, sound: bytes) -> Iterator[bytes]:
        """
        Add the next chunk of the stream.

        Parameters
        ----------
        sound
            Samples in S16LE, 16 kHz, mono, as many as there are.

        Yields
        ------
        bytes
            Each utterance that is complete, with a little silence around it.

        """
        self._rest += self._with_noise(sound)
        size = self._frame_size
        while len(self._rest) >= size:
            frame, self._rest = self._rest[:size], self._rest[size:]
            if self._speech:
                self._go_on(frame)
                if self._is_over:
                    silent = self._frames(_PAUSE_S - _AROUND_S) * size
                    self._speech = self._speech[:-silent]
                    yield self._taken()
                elif duration_s(self._speech) >= self.longest_s:
                    yield self._taken()
            else:
                self._listen(frame)

    def finish(self) -> Iterator[bytes]:
        """Yield the utterance in progress at the end of the stream, if there is one, and reset."""
        if self._speech:
            self._speech += self._rest
            yield self._taken()
        self.reset()

    def _listen(self, frame: bytes) -> None:
        """Start an utterance once there is enough speech."""
        self._before.append(frame)
        self._begin.append(self._vad.is_speech(frame))
        if sum(self._begin) >= self._frames(_BEGIN_S):
            kept = len(self._begin) - self._begin.index(True) + self._frames(_AROUND_S)
            self._speech = b''.join([*self._before][-kept:])
            self._before.clear()
            self._begin.clear()
            self._end.clear()

    def _go_on(self, frame: bytes) -> None:
        self._speech += frame
        self._end.append(self._vad.is_speech(frame))

    @property
    def _is_over(self) -> bool:
        return len(self._end) == self._end.maxlen and sum(self._end) <= _CLICKS

    def _frames(self, seconds: float) -> int:
        return round(seconds / self._frame_s)

    def _taken(self) -> bytes:
        speech, self._speech = self._speech, b''
        return speech

    def _with_noise(self, sound: bytes) -> bytes:
        samples = np.frombuffer(sound[: len(sound) - len(sound) % 2], '<i2').astype(np.float32)
        samples += self._chance.normal(0.0, _NOISE, samples.size)
        return np.clip(samples, -32768, 32767).astype('<i2').tobytes()
