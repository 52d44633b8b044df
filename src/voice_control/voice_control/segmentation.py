# SPDX-License-Identifier: Apache-2.0
"""Find utterances in a stream of sound."""

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
Speech of this length within this time begins an utterance: a short "stop" has no more, and a new
detector takes the first 0.18 s for speech, whatever comes.
"""
_AROUND_S = 0.03
"""Silence that an utterance keeps before and behind it: with more, commands fit worse."""
_PAUSE_S = 0.45
"""Silence of this length ends an utterance: less is the pause that a comma makes."""
_CLICKS = 1
"""How many frames of a pause may sound like speech."""
_NOISE = 3.0
"""Standard deviation, in steps of 16-bit samples, of the noise that is added."""


@dataclass
class UtteranceSegmenter:
    """
    Cuts a stream of sound into utterances, by the voice activity detector of pocketsphinx.

    pocketsphinx's own `Endpointer` has one window for the beginning and the end of speech: with
    one that is long enough for a pause, a short "stop" does not begin an utterance.

    A faint noise is added to what comes in: the mean of the cepstra, by which recognisers
    normalize sound, is of no use after digital silence.

    Parameters
    ----------
    vad_mode
        How readily the detector takes sound for something else than speech: 0 to 3.
    longest_s
        An utterance that is longer is cut there.

    """

    vad_mode: int = 0
    longest_s: float = 10.0

    def __post_init__(self) -> None:
        self._chance = np.random.default_rng(0)
        self._vad = Vad(self.vad_mode)
        self._frame_size = int(self._vad.frame_bytes)
        self._frame_s = float(self._vad.frame_length)
        self.reset()

    @property
    def is_in_speech(self) -> bool:
        """Whether somebody is speaking."""
        return bool(self._speech)

    def reset(self) -> None:
        """Forget what came in: the stream begins anew."""
        self._rest = b''
        self._speech = b''
        window = self._frames(_BEGIN_WITHIN_S)
        self._begin = deque[bool](maxlen=window)
        self._before = deque[bytes](maxlen=window + self._frames(_AROUND_S))
        self._end = deque[bool](maxlen=self._frames(_PAUSE_S))

    def add(self, sound: bytes) -> Iterator[bytes]:
        """
        Take the next piece of the stream.

        Parameters
        ----------
        sound
            Samples in S16LE, 16 kHz, mono, as many as there are.

        Yields
        ------
        bytes
            Each utterance that has come to its end, with a little silence around it.

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
        """Yield the utterance in which the stream ends, if it does; a new one may begin."""
        if self._speech:
            self._speech += self._rest
            yield self._taken()
        self.reset()

    def _listen(self, frame: bytes) -> None:
        """Begin an utterance where there is enough speech."""
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
