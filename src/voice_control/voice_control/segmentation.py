# SPDX-License-Identifier: Apache-2.0
"""Find utterances in a stream of sound."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from pocketsphinx import Endpointer
from voice_control.audio import duration_s

__all__ = ['UtteranceSegmenter']

_PAUSE_S = 0.5
"""Silence of about this length ends an utterance: less is the pause that a comma makes."""
_NOISE = 3.0
"""Standard deviation, in steps of 16-bit samples, of the noise that is added."""


@dataclass
class UtteranceSegmenter:
    """
    Cuts a stream of sound into utterances, by the voice activity detector of pocketsphinx.

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
        self.reset()

    @property
    def is_in_speech(self) -> bool:
        """Whether somebody is speaking."""
        return bool(self._endpointer.in_speech)

    def reset(self) -> None:
        """Forget what came in: the stream begins anew."""
        self._endpointer = Endpointer(window=_PAUSE_S, vad_mode=self.vad_mode)
        self._frame_size = int(self._endpointer.frame_bytes)
        self._rest = b''
        self._speech = b''

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
            self._speech += self._endpointer.process(frame) or b''
            is_over = not self._endpointer.in_speech
            if self._speech and (is_over or duration_s(self._speech) >= self.longest_s):
                yield self._taken()

    def finish(self) -> Iterator[bytes]:
        """Yield the utterance in which the stream ends, if it does; a new one may begin."""
        # It takes no empty frame.
        last = self._endpointer.end_stream(self._rest[: self._frame_size] or bytes(2))
        self._speech += last or b''
        if self._speech:
            yield self._taken()
        self.reset()

    def _taken(self) -> bytes:
        speech, self._speech = self._speech, b''
        return speech

    def _with_noise(self, sound: bytes) -> bytes:
        samples = np.frombuffer(sound[: len(sound) - len(sound) % 2], '<i2').astype(np.float32)
        samples += self._chance.normal(0.0, _NOISE, samples.size)
        return np.clip(samples, -32768, 32767).astype('<i2').tobytes()
