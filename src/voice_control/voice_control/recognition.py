# SPDX-License-Identifier: Apache-2.0
"""Interfaces of recognisers, and a listener that combines them and always hears "stop"."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
import time
from typing import Protocol

from humanoid_common.errors import UserError
from voice_control.audio import duration_s

__all__ = [
    'CommandRecognizer',
    'FreeRecognizer',
    'Heard',
    'Listener',
    'Recognition',
    'Recognizer',
    'RecognizerError',
]

_SAME = 0.7
"""Similarity, from 0 to 1, above which two texts are taken for the same words."""


class RecognizerError(UserError):
    """A recogniser cannot be used; the message suggests a remedy."""


@dataclass(frozen=True)
class Recognition:
    """
    Result of the recognition of an utterance.

    Attributes
    ----------
    text
        The words, in lower case; empty if there are none.
    confidence
        The confidence; its scale depends on the recogniser.
    backend
        The name of the recogniser.
    reason
        Why the words are rejected, as a message; empty if they are accepted.
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
        """Whether the words are accepted."""
        return not self.reason


@dataclass(frozen=True)
class Heard:
    """A recognition, the duration of its utterance, and the processing time (s)."""

    recognition: Recognition
    speech_s: float
    processing_s: float


class Recognizer(Protocol):
    """Recogniser that turns utterances into words."""

    title: str
    """The description of the recogniser, for the log."""

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
            If the recogniser is temporarily unavailable.

        """


class CommandRecognizer(Recognizer, Protocol):
    """Recogniser of the commands of a grammar that knows which of them stop the robot."""

    def set_grammar(self, jsgf: str) -> list[str]:
        """
        Replace the grammar of commands.

        Parameters
        ----------
        jsgf
            A grammar in JSGF 1.0.

        Returns
        -------
        list[str]
            The words that cannot be recognized.

        Raises
        ------
        RecognizerError
            If the grammar is invalid; the previous one stays.

        """

    def accepts(self, text: str) -> bool:
        """
        Check whether a text is a command of the grammar.

        Parameters
        ----------
        text
            Words in lower case, separated by spaces.

        """

    @property
    def examples(self) -> Sequence[str]:
        """Commands that the grammar gives as examples."""


class FreeRecognizer(Recognizer, Protocol):
    """Recogniser of free speech."""

    def expect(self, examples: Sequence[str]) -> None:
        """
        Prime the recogniser with likely commands.

        Parameters
        ----------
        examples : Sequence[str]
            Commands; a recogniser may use only the first ones.

        """


class Listener:
    """
    Recogniser of utterances that always recognizes "stop" with the grammar.

    A second recogniser hears free speech, and confuses some words that sound alike. Where its text
    is no command, but similar to the one that the grammar's recogniser accepts, the latter counts.

    Parameters
    ----------
    grammar
        The recogniser of commands, which knows those that stop the robot.
    other
        The recogniser of everything else; by default the grammar's, too.
    wake_word
        If given, utterances are accepted only if they begin with it; "stop" always is.
    report
        Called with a message when the other recogniser fails; the grammar replaces it then.

    """

    def __init__(
        self,
        grammar: CommandRecognizer,
        other: FreeRecognizer | None = None,
        wake_word: str = '',
        report: Callable[[str], None] = lambda sentence: None,
    ) -> None:
        self._grammar = grammar
        self._other = other
        self._wake_word = wake_word.lower().split()
        self._report = report
        self._has_grammar = False

    @property
    def is_ready(self) -> bool:
        """Whether it can recognize more than "stop": before the first grammar, it may not."""
        return self._has_grammar or self._other is not None

    def set_grammar(self, jsgf: str) -> list[str]:
        """
        Replace the grammar of commands.

        Parameters
        ----------
        jsgf
            The grammar. Its examples prime a recogniser of free speech.

        Returns
        -------
        list[str]
            The words that the grammar's recogniser cannot recognize.

        Raises
        ------
        RecognizerError
            If the grammar is invalid; the previous one stays.

        """
        unheard = self._grammar.set_grammar(jsgf)
        self._has_grammar = True
        if self._other is not None:
            self._other.expect(self._grammar.examples)
        return unheard

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
                recognition = self._better(recognition, self._other.recognize(sound))
            except RecognizerError as error:
                self._report(f'{error} The grammar is used instead.')
        return self._woken(recognition)

    def _better(self, command: Recognition, free: Recognition) -> Recognition:
        """Prefer a command to free words that are nearly the same: "go to the hole"."""
        is_nearly_command = (
            command.is_accepted
            and not self._grammar.accepts(free.text)
            and SequenceMatcher(a=command.text, b=free.text).ratio() >= _SAME
        )
        return command if is_nearly_command else free

    def _woken(self, recognition: Recognition) -> Recognition:
        """Strip the wake word, or reject an utterance that does not begin with it."""
        words = recognition.text.replace(',', ' ').split()
        count = len(self._wake_word)
        if not count or not words:
            return recognition
        if words[:count] == self._wake_word:
            return replace(recognition, text=' '.join(words[count:]))
        reason = recognition.reason or f'It did not start with "{" ".join(self._wake_word)}".'
        return replace(recognition, reason=reason)
