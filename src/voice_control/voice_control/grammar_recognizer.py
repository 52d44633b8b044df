# SPDX-License-Identifier: Apache-2.0
"""Recognize the commands of a grammar, offline, with pocketsphinx."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
import math
import re

from pocketsphinx import Decoder, get_model_path
from voice_control.recognition import Recognition, RecognizerError
from voice_control.word_network import compile_jsgf

__all__ = ['STOP_GRAMMAR', 'THRESHOLD', 'GrammarRecognizer', 'read_dictionary']

BACKEND = 'pocketsphinx'
THRESHOLD = -3.2
"""The least log-likelihood ratio per frame of a command, if nothing else is said."""
STOP_GRAMMAR = """#JSGF V1.0;
grammar stop;
public <command> = <stop_phrase>;
<stop_phrase> = (stop | halt | freeze) [(it | that | now)] | emergency stop;
"""
"""What is heard before another grammar comes."""

_COMMANDS, _PHONES = 'commands', 'phones'
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
_PHRASE_OF_PHONES = re.compile(r'[A-Z]{1,2}( [A-Z]{1,2})*')


def read_dictionary(lines: Iterable[str]) -> dict[str, str]:
    """
    Read words with their phones, as in CMUdict: `kitchenette K IH CH AH N EH T`.

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


class GrammarRecognizer:
    """
    Recognizes what a grammar allows, and rejects what is something else.

    A grammar forces any sound into its words. So an utterance is recognized a second time as a
    loop of phones, which may follow in any order: the mean, over the frames of the words, of the
    log-likelihood ratio of the two tells commands (mostly -1 to -3) from other sentences (mostly
    below -3.5); measured with synthetic voices.

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
            fsg = self._decoder.create_fsg(_COMMANDS, 0, last, [*arcs, *ends])
            self._decoder.add_fsg(_COMMANDS, fsg)
            self._decoder.activate_search(_COMMANDS)
        except (RecognizerError, ValueError, RuntimeError) as error:
            raise RecognizerError(f'The grammar of commands cannot be used. {error}') from error
        return list(network.unknown)

    def recognize(self, sound: bytes) -> Recognition:
        """Recognize an utterance; see `Recognizer`."""
        segments = self._decoded(_COMMANDS, sound)
        words = [segment for segment in segments if segment[0][0] not in '<([']
        if not words:
            return Recognition('', -math.inf, BACKEND, 'No command was recognized.')
        text = ' '.join(word.partition('(')[0] for word, *_ in words)
        ratio = self._log_likelihood_ratio(segments, words[0][1], words[-1][2], sound)
        is_like = ratio >= self.threshold
        is_stop = bool(_STOP_WORDS.intersection(text.split()[:_STOP_WITHIN])) and (
            is_like or len(words) <= _SHORT_STOP
        )
        reason = ''
        if not is_like and not is_stop:
            reason = f'It did not sound much like "{text}", the closest command.'
        return Recognition(text, ratio, BACKEND, reason, is_stop)

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

    def _decoded(self, search: str, sound: bytes) -> list[tuple[str, int, int, float]]:
        """Decode a sound; return words or phones with first and last frame and log-likelihood."""
        self._decoder.activate_search(search)
        self._decoder.start_utt()
        self._decoder.process_raw(sound)
        self._decoder.end_utt()
        return [
            (each.word, each.start_frame, each.end_frame, _SCORE_SCALE * math.log(each.ascore))
            for each in self._decoder.seg() or ()
        ]

    def _log_likelihood_ratio(
        self, segments: list[tuple[str, int, int, float]], first: int, last: int, sound: bytes
    ) -> float:
        """Compute the ratio of words and phones, per frame from the first to the last one."""
        of_words = sum(
            score for _, begin, end, score in segments if begin >= first and end <= last
        )
        of_phones = sum(
            score * max(0, min(end, last) - max(begin, first) + 1) / (end - begin + 1)
            for _, begin, end, score in self._decoded(_PHONES, sound)
        )
        return (of_words - of_phones) / (last - first + 1)
