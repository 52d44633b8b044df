# SPDX-License-Identifier: Apache-2.0
"""What a recogniser is, and how several of them make one that always hears "stop"."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
import time
from typing import Protocol

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
"""How similar two texts are, from 0 to 1, that are taken for the same words."""


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


class CommandRecognizer(Recognizer, Protocol):
    """Turns utterances into the commands of a grammar; knows which of them stop the robot."""

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
            The words that cannot be heard.

        Raises
        ------
        RecognizerError
            If it is no grammar; the one of before stays.

        """

    def accepts(self, text: str) -> bool:
        """
        Check whether a text is a command of the grammar.

        Parameters
        ----------
        text
            Words in lower case, parted by spaces.

        """

    @property
    def examples(self) -> Sequence[str]:
        """Commands that the grammar gives as examples."""


class FreeRecognizer(Recognizer, Protocol):
    """Turns utterances into words of all kinds."""

    def expect(self, examples: Sequence[str]) -> None:
        """
        Prime the recogniser with commands that are likely.

        Parameters
        ----------
        examples : Sequence[str]
            Commands; a recogniser may take only the first ones.

        """


class Listener:
    """
    Recognizes utterances, "stop" among them always by the grammar.

    Another recogniser hears words of all kinds, and takes some for others that sound like them.
    Where it hears no command, but nearly the one that the grammar's recogniser accepts, that
    counts.

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
        grammar: CommandRecognizer,
        other: FreeRecognizer | None = None,
        wake_word: str = '',
        report: Callable[[str], None] = lambda sentence: None,
    ) -> None:
        self._grammar = grammar
        self._other = other
        self._wake_word = wake_word.lower().split()
        self._report = report

    def set_grammar(self, jsgf: str) -> list[str]:
        """
        Replace the grammar of commands.

        Parameters
        ----------
        jsgf
            The grammar. A recogniser of free speech gets examples of it.

        Returns
        -------
        list[str]
            The words that the grammar's recogniser cannot hear.

        Raises
        ------
        RecognizerError
            If it is no grammar; the one of before stays.

        """
        unheard = self._grammar.set_grammar(jsgf)
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
        """Take a command rather than free words that are nearly those: "go to the hole"."""
        is_nearly_command = (
            command.is_accepted
            and not self._grammar.accepts(free.text)
            and SequenceMatcher(a=command.text, b=free.text).ratio() >= _SAME
        )
        return command if is_nearly_command else free

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
