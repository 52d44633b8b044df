# SPDX-License-Identifier: Apache-2.0
"""What a recogniser is, and how several of them make one that always hears "stop"."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
import time
from typing import Protocol

from voice_control.audio import duration_s

__all__ = ['Heard', 'Listener', 'Recognition', 'Recognizer', 'RecognizerError']


class RecognizerError(Exception):
    """A recogniser that cannot be used; the text is a sentence with a way out."""


@dataclass(frozen=True)
class Recognition:
    """
    What a recogniser made of an utterance.

    Attributes
    ----------
    text
        The words, in lower case; empty if there are none.
    confidence
        How sure it is; what the number means depends on the recogniser.
    backend
        Its name.
    reason
        Why the words do not count, as a sentence; empty if they do.
    is_stop
        Whether they tell the robot to stop.

    """

    text: str
    confidence: float
    backend: str
    reason: str = ''
    is_stop: bool = False

    @property
    def is_accepted(self) -> bool:
        """Whether the words count."""
        return not self.reason


@dataclass(frozen=True)
class Heard:
    """A recognition, the length of its utterance, and how long recognising it took (s)."""

    recognition: Recognition
    speech_s: float
    processing_s: float


class Recognizer(Protocol):
    """Turns utterances into words."""

    title: str
    """What it is, for the log."""

    def recognize(self, sound: bytes) -> Recognition:
        """
        Recognize the words of an utterance.

        Parameters
        ----------
        sound
            Samples in S16LE, 16 kHz, mono.

        Raises
        ------
        RecognizerError
            If it cannot be used for the moment.

        """


class Listener:
    """
    Recognizes utterances, "stop" among them always by the grammar.

    Parameters
    ----------
    grammar
        Hears commands of a grammar, and knows which of them tells the robot to stop.
    other
        Hears everything else; by default that is the grammar, too.
    wake_word
        If there is one, utterances count only if they begin with it; "stop" always does.
    report
        Gets the sentence when the other recogniser fails; the grammar takes its place then.

    """

    def __init__(
        self,
        grammar: Recognizer,
        other: Recognizer | None = None,
        wake_word: str = '',
        report: Callable[[str], None] = lambda sentence: None,
    ) -> None:
        self._grammar = grammar
        self._other = other
        self._wake_word = wake_word.lower().split()
        self._report = report

    def hear(self, sound: bytes) -> Heard:
        """
        Recognize an utterance.

        Parameters
        ----------
        sound
            Samples in S16LE, 16 kHz, mono.

        """
        began_s = time.monotonic()
        recognition = self._recognition(sound)
        return Heard(recognition, duration_s(sound), time.monotonic() - began_s)

    def _recognition(self, sound: bytes) -> Recognition:
        recognition = self._grammar.recognize(sound)
        if recognition.is_stop:
            return recognition
        if self._other is not None:
            try:
                recognition = self._other.recognize(sound)
            except RecognizerError as error:
                self._report(f'{error} The grammar is used instead.')
        return self._woken(recognition)

    def _woken(self, recognition: Recognition) -> Recognition:
        """Take the wake word off, or reject what does not begin with it."""
        words = recognition.text.replace(',', ' ').split()
        count = len(self._wake_word)
        if not count or not words:
            return recognition
        if words[:count] == self._wake_word:
            return replace(recognition, text=' '.join(words[count:]))
        reason = recognition.reason or f'It did not begin with "{" ".join(self._wake_word)}".'
        return replace(recognition, reason=reason)
