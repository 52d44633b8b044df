# SPDX-License-Identifier: Apache-2.0
"""Recognize the commands of a grammar offline, with pocketsphinx."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
import math
import re

from pocketsphinx import Decoder, get_model_path
from voice_control.audio import duration_s
from voice_control.cepstra import CEPSTRA, CepstralFrontEnd
from voice_control.jsgf import compile_jsgf
from voice_control.noise_suppression import signal_to_noise_db
from voice_control.pronunciations import FLUENT
from voice_control.recognition import Recognition, RecognizerError
from voice_control.recognizer_parameters import THRESHOLD
from voice_control.word_network import WordNetwork

__all__ = ['STOP_GRAMMAR', 'GrammarRecognizer', 'read_dictionary']

BACKEND = 'pocketsphinx'
STOP_THRESHOLD = -2.7
"""The minimum log-likelihood ratio per frame of a phrase that stops the robot."""
STOP_MARGIN = 1.8
"""How much better than such a phrase the closest command may fit: to miss a stop is worse."""
CLEAR_STOP = -1.6
"""The ratio above which such a phrase in noise is believed before noise suppression."""
_LONGEST_STOP_S = 1.5
"""The length of an utterance up to which such phrases are sought before noise suppression."""
NOISY_DB = 30.0
"""The signal-to-noise ratio below which commands are sought after noise suppression only."""
STOP_GRAMMAR = """#JSGF V1.0;
grammar stop;
public <command> = [(please | robot)] <stop_phrase> [(please | robot)];
<stop_phrase> = <stop> [(it | that | now | right now | moving | <stop>)] | emergency stop;
<stop> = stop | halt | freeze;
"""
"""Phrases that are recognized at all times, whatever the grammar of commands is."""

_COMMANDS, _PHONES, _STOPS = 'commands', 'phones', 'stops'
_STOP_WORDS = frozenset(('stop', 'halt', 'freeze'))
_STOP_WITHIN = 3
"""Number of initial words among which a stop word counts: "please stop", "emergency stop"."""
_GRAMMAR_WEIGHT = 3.0
"""
Language weight: how much the word probabilities of the grammar count against the sound. The `lw`
of pocketsphinx has no effect on a grammar that comes from a program.
"""
_PHONE_WEIGHT = 3.0
"""Language weight of the phone loop."""
_SCORE_SCALE = 1024.0
"""The factor by which pocketsphinx scales down its log-likelihoods."""
_SHORTEST_HALF = 3
"""Minimum number of letters of each half of a compound word."""
_NO_MEAN = ','.join('0' * CEPSTRA)
"""The cepstral mean that pocketsphinx is to subtract: the front end has subtracted it."""
_NO_GRAMMAR = 'Only "stop" is recognized as long as no grammar comes from the planner.'
_PHRASE_OF_PHONES = re.compile(r'[A-Z]{1,2}( [A-Z]{1,2})*')


def read_dictionary(lines: Iterable[str]) -> dict[str, str]:
    """
    Parse a pronunciation dictionary in the format of CMUdict: `kitchenette K IH CH AH N EH T`.

    Parameters
    ----------
    lines
        Lines of a word and its phones; text after `#` is a comment.

    Returns
    -------
    dict
        The phones, separated by spaces, by the word in lower case.

    Raises
    ------
    RecognizerError
        If a line has another format.

    """
    words = {}
    for number, line in enumerate(lines, start=1):
        word, _, phones = line.partition('#')[0].strip().partition(' ')
        if not word:
            continue
        if not _PHRASE_OF_PHONES.fullmatch(phones.strip()):
            raise RecognizerError(
                f'Line {number} of the dictionary, {line.strip()!r}, is not a word followed '
                'by its phones, such as: kitchenette K IH CH AH N EH T'
            )
        words[word.lower()] = phones.strip()
    return words


@dataclass(frozen=True)
class _Segment:
    """A word or phone, its first and last frame, and its log-likelihood."""

    name: str
    first: int
    last: int
    score: float


@dataclass(frozen=True)
class _Fit:
    """The best match of an utterance in a grammar, and its log-likelihood ratio per frame."""

    text: str
    ratio: float


_NOTHING = _Fit('', -math.inf)


class GrammarRecognizer:
    """
    Recogniser of the commands of a grammar, which rejects everything else.

    A grammar forces any sound into its words. An utterance is therefore decoded a second time by a
    phone loop, in which phones follow in any order: the log-likelihood ratio of the two, averaged
    over the frames, separates commands (mostly above -1) from other sentences (mostly below), as
    measured with synthetic voices. Stop words have a small grammar of their own in addition, since
    a short "stop" is easily confused with another of some hundred words. A phrase of it counts if
    its own ratio is high enough, and no command fits much better.

    Before the first grammar, only stop phrases are recognized.

    With noise suppression, commands in a noisy utterance are sought without its noise. In a short
    one, stop phrases are sought before that, too: suppression may take a short word for noise.

    Parameters
    ----------
    threshold
        The minimum log-likelihood ratio per frame for acceptance of a command.
    dictionary
        Words with their phones, in addition to the 135,000 of CMUdict.
    suppress
        Removes the noise from an utterance (S16LE, 16 kHz, mono); None for no noise suppression.

    """

    def __init__(
        self,
        threshold: float = THRESHOLD,
        dictionary: Mapping[str, str] = {},
        suppress: Callable[[bytes], bytes] | None = None,
    ) -> None:
        self.threshold = threshold
        self._suppress = suppress
        self.title = f'pocketsphinx (grammar, threshold {threshold:g})'
        # A best-path search through the lattice could end anywhere in the grammar. Scores are
        # relative to the best state that is scored: those of two searches compare if all are.
        self._decoder = Decoder(
            loglevel='FATAL', lm=None, bestpath=False, lw=_PHONE_WEIGHT, compallsen=True
        )
        for word, phones in FLUENT.items():
            self._add_variant(word, phones)
        for word, phones in dictionary.items():
            self._decoder.add_word(word, phones, True)
        self._decoder.add_allphone_file(_PHONES, get_model_path('en-us/en-us-phone.lm.bin'))
        self._original, self._suppressed = CepstralFrontEnd(), CepstralFrontEnd()
        self._commands: WordNetwork | None = None
        self._add(_STOPS, compile_jsgf(STOP_GRAMMAR))

    def set_grammar(self, jsgf: str) -> list[str]:
        """
        Replace the grammar.

        Parameters
        ----------
        jsgf
            A grammar in JSGF 1.0. A compound such as "sideboard" is pronounced like its halves.
            Sentences that need a word of unknown pronunciation are left out.

        Returns
        -------
        list[str]
            The words whose pronunciation is unknown.

        Raises
        ------
        RecognizerError
            If the grammar is invalid; the previous one stays.

        """
        try:
            network = compile_jsgf(jsgf, self._knows)
            self._add(_COMMANDS, network)
            self._commands = network
        except (RecognizerError, ValueError, RuntimeError) as error:
            raise RecognizerError(f'The grammar of commands cannot be used. {error}') from error
        return list(network.unknown)

    def accepts(self, text: str) -> bool:
        """
        Check whether a text is a command of the grammar.

        Parameters
        ----------
        text
            Words in lower case, separated by spaces.

        """
        return self._commands is not None and self._commands.accepts(text)

    @property
    def examples(self) -> Sequence[str]:
        """Commands that the grammar gives as examples."""
        return () if self._commands is None else self._commands.shown

    def recognize(self, sound: bytes) -> Recognition:
        """
        Recognize a command of the grammar, or a phrase that stops the robot.

        Parameters
        ----------
        sound
            As for `Recognizer.recognize`.

        Returns
        -------
        Recognition
            The closest command, with a reason if it is rejected. Its confidence is the
            log-likelihood ratio per frame.

        """
        if self._suppress is None or signal_to_noise_db(sound) >= NOISY_DB:
            return self._recognition(self._original.features(sound))
        if duration_s(sound) <= _LONGEST_STOP_S:
            features = self._original.features(sound)
            stop = self._fit(_STOPS, features, self._decoded(_PHONES, features))
            if stop.ratio >= CLEAR_STOP:
                return Recognition(stop.text, stop.ratio, BACKEND, is_stop=True)
        return self._recognition(self._suppressed.features(self._suppress(sound)))

    def _recognition(self, features: bytes) -> Recognition:
        """Recognize an utterance from the features of its front end."""
        phones = self._decoded(_PHONES, features)
        command = _NOTHING
        if self._commands is not None:
            command = self._fit(_COMMANDS, features, phones)
        stop = self._fit(_STOPS, features, phones)
        if stop.ratio >= max(STOP_THRESHOLD, command.ratio - STOP_MARGIN):
            return Recognition(stop.text, stop.ratio, BACKEND, is_stop=True)
        words = command.text.split()
        if not words:
            reason = _NO_GRAMMAR if self._commands is None else 'No command was recognized.'
            return Recognition('', -math.inf, BACKEND, reason)
        if command.ratio >= self.threshold:
            is_stop = not _STOP_WORDS.isdisjoint(words[:_STOP_WITHIN])
            return Recognition(command.text, command.ratio, BACKEND, is_stop=is_stop)
        closest = f'It did not sound much like "{command.text}", the closest command.'
        return Recognition(command.text, command.ratio, BACKEND, closest)

    def _add(self, search: str, network: WordNetwork) -> None:
        """Create a decoder search from a word network; it replaces one of the same name."""
        last = len(network.arcs)
        # What can come at a state has probabilities that sum up to 1: words in proportion to their
        # weights, and the end of a command as likely as all words together.
        power = _GRAMMAR_WEIGHT if search == _COMMANDS else 1.0
        arcs, ends = [], []
        for state, words in enumerate(network.arcs):
            weights = network.weights[state]
            on = sum(weights.values())
            end = (on or 1.0) if search == _COMMANDS else 1.0
            total = on + end if state in network.finals else on
            arcs += [
                (state, words[word], (weights[word] / total) ** power, word) for word in words
            ]
            if state in network.finals:
                ends.append((state, last, (end / total) ** power))
        fsg = self._decoder.create_fsg(search, 0, last, [*arcs, *ends])
        self._decoder.add_fsg(search, fsg)
        self._decoder.activate_search(search)

    def _add_variant(self, word: str, phones: str) -> None:
        """Add a further pronunciation of a word: those after the first are numbered from 2 on."""
        number = 2
        while self._decoder.lookup_word(f'{word}({number})') is not None:
            number += 1
        self._decoder.add_word(f'{word}({number})', phones, True)

    def _knows(self, word: str) -> bool:
        """Check whether a word has a pronunciation; add that of a compound from its halves."""
        if self._decoder.lookup_word(word) is not None:
            return True
        for middle in range(_SHORTEST_HALF, len(word) - _SHORTEST_HALF + 1):
            halves = [self._decoder.lookup_word(each) for each in (word[:middle], word[middle:])]
            if all(halves):
                self._decoder.add_word(word, ' '.join(halves), True)
                return True
        return False

    def _decoded(self, search: str, features: bytes) -> list[_Segment]:
        """Decode an utterance into the words or phones of a search."""
        self._decoder.activate_search(search)
        self._decoder.set_cmn(_NO_MEAN)
        self._decoder.start_utt()
        self._decoder.process_cep(features)
        self._decoder.end_utt()
        return [
            _Segment(
                each.word, each.start_frame, each.end_frame, _SCORE_SCALE * math.log(each.ascore)
            )
            for each in self._decoder.seg() or ()
        ]

    def _fit(self, search: str, features: bytes, phones: Sequence[_Segment]) -> _Fit:
        """Decode an utterance; compute its log-likelihood ratio to the phone loop, per frame."""
        segments = self._decoded(search, features)
        words = [segment for segment in segments if segment.name[0] not in '<([']
        if not words:
            return _NOTHING
        first, last = segments[0].first, segments[-1].last
        of_words = sum(each.score for each in segments)
        of_phones = sum(
            each.score
            * max(0, min(each.last, last) - max(each.first, first) + 1)
            / (each.last - each.first + 1)
            for each in phones
        )
        text = ' '.join(word.name.partition('(')[0] for word in words)
        return _Fit(text, (of_words - of_phones) / (last - first + 1))
