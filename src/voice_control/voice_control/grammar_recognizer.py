# SPDX-License-Identifier: Apache-2.0
"""Recognize the commands of a grammar, offline, with pocketsphinx."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
import math
import re

from pocketsphinx import Decoder, get_model_path
from voice_control.recognition import Recognition, RecognizerError
from voice_control.word_network import compile_jsgf, WordNetwork

__all__ = ['STOP_GRAMMAR', 'THRESHOLD', 'GrammarRecognizer', 'read_dictionary']

BACKEND = 'pocketsphinx'
THRESHOLD = -3.2
"""The least log-likelihood ratio per frame of a command, if nothing else is said."""
STOP_THRESHOLD = -2.25
"""The least log-likelihood ratio per frame of a phrase that stops the robot."""
STOP_MARGIN = 0.8
"""By how much such a phrase must fit better than the closest command, if that is another."""
STOP_GRAMMAR = """#JSGF V1.0;
grammar stop;
public <command> = [(please | robot)] <stop_phrase> [(please | robot)];
<stop_phrase> = <stop> [(it | that | now | right now | moving | <stop>)] | emergency stop;
<stop> = stop | halt | freeze;
"""
"""What is listened for at all times, whatever the grammar of commands is."""

_COMMANDS, _PHONES, _STOPS = 'commands', 'phones', 'stops'
_STOP_WORDS = frozenset(('stop', 'halt', 'freeze'))
_STOP_WITHIN = 3
"""Among how many words at the beginning a word to stop counts: "please stop", "emergency stop"."""
_GRAMMAR_WEIGHT = 3.0
"""How much it counts, against the sound, that a place in the grammar has many words to choose."""
_SHORT_STOP = 4
"""Words of a sentence that stops the robot however badly it fits; longer ones may be chance."""
_SCORE_SCALE = 1024.0
"""pocketsphinx keeps log-likelihoods divided by this."""
_SHORTEST_HALF = 3
"""Letters that a half of a compound word has at least."""
_FIRST_PASSES = 3
"""How often the mean of the cepstra is learnt from the first utterance, by which it is unknown."""
_PHRASE_OF_PHONES = re.compile(r'[A-Z]{1,2}( [A-Z]{1,2})*')


def read_dictionary(lines: Iterable[str]) -> dict[str, str]:
    """
    Parse a pronunciation dictionary, as CMUdict is: `kitchenette K IH CH AH N EH T`.

    Parameters
    ----------
    lines
        A word and its phones each; what follows `#` is a comment.

    Returns
    -------
    dict
        The phones, parted by spaces, by the word in lower case.

    Raises
    ------
    RecognizerError
        If a line is none of that kind.

    """
    words = {}
    for number, line in enumerate(lines, start=1):
        word, _, phones = line.partition('#')[0].strip().partition(' ')
        if not word:
            continue
        if not _PHRASE_OF_PHONES.fullmatch(phones.strip()):
            raise RecognizerError(
                f'Line {number} of the dictionary, {line.strip()!r}, has no word with phones '
                'behind it, such as: kitchenette K IH CH AH N EH T'
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
    """What a grammar makes of an utterance, and how well that fits (log-likelihood a frame)."""

    text: str
    ratio: float


class GrammarRecognizer:
    """
    Recognizes what a grammar allows, and rejects what is something else.

    A grammar forces any sound into its words. So an utterance is recognized a second time as a
    loop of phones, which may follow in any order: the mean, over the frames of the words, of the
    log-likelihood ratio of the two tells commands (mostly -1 to -3) from other sentences (mostly
    below -3.5); measured with synthetic voices. Words to stop have a small grammar of their own
    besides, since a short "stop" is easily taken for another of some hundred words.

    Parameters
    ----------
    threshold
        The least log-likelihood ratio per frame of what is accepted; a short sentence with a word
        to stop always is.
    dictionary
        Words with their phones, besides the 135,000 of CMUdict.

    """

    def __init__(self, threshold: float = THRESHOLD, dictionary: Mapping[str, str] = {}) -> None:
        self.threshold = threshold
        self.title = f'pocketsphinx (grammar, threshold {threshold:g})'
        # A search for the best path through the lattice would end anywhere in the grammar.
        self._decoder = Decoder(loglevel='FATAL', lm=None, bestpath=False, lw=_GRAMMAR_WEIGHT)
        for word, phones in dictionary.items():
            self._decoder.add_word(word, phones, True)
        self._decoder.add_allphone_file(_PHONES, get_model_path('en-us/en-us-phone.lm.bin'))
        self._mean = ''
        self._add(_STOPS, compile_jsgf(STOP_GRAMMAR))
        self.set_grammar(STOP_GRAMMAR)

    def set_grammar(self, jsgf: str) -> list[str]:
        """
        Replace the grammar.

        Parameters
        ----------
        jsgf
            A grammar in JSGF 1.0. A compound such as "sideboard" is pronounced as its halves are.
            What it allows only with a word of unknown pronunciation cannot be said.

        Returns
        -------
        list[str]
            The words whose pronunciation is not known.

        Raises
        ------
        RecognizerError
            If it is no grammar; the one of before stays.

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
            Words in lower case, parted by spaces.

        """
        return self._commands.accepts(text)

    @property
    def examples(self) -> Sequence[str]:
        """Commands that the grammar gives as examples."""
        return self._commands.shown

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
            The closest command, with a reason if it does not count. Its confidence is the
            log-likelihood ratio per frame.

        """
        self._learn_mean(sound)
        phones = self._decoded(_PHONES, sound)
        command = self._fit(_COMMANDS, sound, phones)
        stop = self._fit(_STOPS, sound, phones)
        is_like = command.ratio >= self.threshold
        words = command.text.split()
        if _STOP_WORDS.intersection(words[:_STOP_WITHIN]) and (
            is_like or len(words) <= _SHORT_STOP
        ):
            return Recognition(command.text, command.ratio, BACKEND, is_stop=True)
        if stop.ratio >= max(STOP_THRESHOLD, command.ratio + STOP_MARGIN):
            return Recognition(stop.text, stop.ratio, BACKEND, is_stop=True)
        if not words:
            return Recognition('', -math.inf, BACKEND, 'No command was recognized.')
        closest = f'It did not sound much like "{command.text}", the closest command.'
        return Recognition(command.text, command.ratio, BACKEND, '' if is_like else closest)

    def _add(self, search: str, network: WordNetwork) -> None:
        """Make a search of a network of words, in place of one with the same name."""
        last = len(network.arcs)
        # All words at a place are equally likely; so is the end of the sentence.
        shares = [
            1.0 / (len(words) + (state in network.finals))
            for state, words in enumerate(network.arcs)
        ]
        arcs = [
            (state, target, shares[state], word)
            for state, words in enumerate(network.arcs)
            for word, target in words.items()
        ]
        ends = [(state, last, shares[state]) for state in network.finals]
        fsg = self._decoder.create_fsg(search, 0, last, [*arcs, *ends])
        self._decoder.add_fsg(search, fsg)
        self._decoder.activate_search(search)

    def _knows(self, word: str) -> bool:
        """Return whether a word has a pronunciation, or a compound one from its two halves."""
        if self._decoder.lookup_word(word) is not None:
            return True
        for middle in range(_SHORTEST_HALF, len(word) - _SHORTEST_HALF + 1):
            halves = [self._decoder.lookup_word(each) for each in (word[:middle], word[middle:])]
            if all(halves):
                self._decoder.add_word(word, ' '.join(halves), True)
                return True
        return False

    def _learn_mean(self, sound: bytes) -> None:
        """
        Let an utterance change the mean of the cepstra, by which all searches normalize it.

        pocketsphinx would change it after each search, so that one search had another mean than
        the next one.
        """
        for _ in range(1 if self._mean else _FIRST_PASSES):
            self._decoded(_STOPS, sound)  # the quickest one
            self._mean = self._decoder.get_cmn()

    def _decoded(self, search: str, sound: bytes) -> list[_Segment]:
        """Decode a sound into the words or phones of a search."""
        self._decoder.activate_search(search)
        if self._mean:
            self._decoder.set_cmn(self._mean)
        self._decoder.start_utt()
        self._decoder.process_raw(sound)
        self._decoder.end_utt()
        return [
            _Segment(
                each.word, each.start_frame, each.end_frame, _SCORE_SCALE * math.log(each.ascore)
            )
            for each in self._decoder.seg() or ()
        ]

    def _fit(self, search: str, sound: bytes, phones: Sequence[_Segment]) -> _Fit:
        """Return what a search finds, and its log-likelihood ratio to the phones, per frame."""
        segments = self._decoded(search, sound)
        words = [segment for segment in segments if segment.name[0] not in '<([']
        if not words:
            return _Fit('', -math.inf)
        first, last = words[0].first, words[-1].last
        of_words = sum(
            each.score for each in segments if each.first >= first and each.last <= last
        )
        of_phones = sum(
            each.score
            * max(0, min(each.last, last) - max(each.first, first) + 1)
            / (each.last - each.first + 1)
            for each in phones
        )
        text = ' '.join(word.name.partition('(')[0] for word in words)
        return _Fit(text, (of_words - of_phones) / (last - first + 1))
