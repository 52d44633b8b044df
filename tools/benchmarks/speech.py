# SPDX-License-Identifier: Apache-2.0
"""
Count how many spoken commands are understood, and how many other sentences are taken for one.

Synthesizers of the system, flite and espeak-ng, speak the commands of the planner's tests, and
sentences that are not commands; the recogniser has the grammar of the planner in the apartment,
or is Whisper with a model of yours (`--whisper FOLDER`), beside which the grammar hears "stop".
A command is right if what would be done is the same as for the spoken text: the plans are equal,
or differ only by "a" for "the" or the other way round, in the column "article", where both lead to
a plan. ("The mug" makes the robot ask, and not act, if it knows two; that counts as rejected.)
In "wrong" are all the rest. Others are taken for a command or for a stop. A stop is right if it
stops the robot. `--roc` counts for several thresholds which commands are right, and which others
are taken.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
import math
from pathlib import Path
import re
import shlex
import shutil
import subprocess
import sys
from tempfile import TemporaryDirectory
import time
from zlib import crc32

from arguments import in_range
from humanoid_common.errors import UserError
from llm_planner.dialogue import Dialogue
from llm_planner.plan import Plan
from llm_planner.rules import RulePlanner
from llm_planner.world import World
import numpy as np
from numpy.typing import NDArray
from planner import apartment, KINDS, TESTS
from voice_control.audio import AudioError, chunks, duration_s, RATE_HZ, read_wav, wav_of
from voice_control.grammar_recognizer import GrammarRecognizer
from voice_control.noise_suppression import NoiseSuppressor
from voice_control.recognition import Listener
from voice_control.recognizer_parameters import THRESHOLD
from voice_control.segmentation import UtteranceSegmenter
from voice_control.whisper import FasterWhisper
import yaml

OTHER = (
    'the weather is nice today', 'i had pasta for lunch yesterday',
    'please call my mother tonight', 'the football match starts at nine',
    'she sells sea shells by the sea shore', 'can you lend me some money',
    'the quick brown fox jumps over the lazy dog', 'my car needs new brakes',
    'let us watch a movie later', 'good morning everyone how was the weekend',
    'the kitchen sink is leaking again', 'who is going to win the election',
    'did you watch the news last night', 'i will meet you at the station at six',
    'the train was late again this morning', 'we should paint the fence next summer',
    'my sister has two cats and a dog', 'do you take milk in your coffee',
    'the meeting was moved to thursday', 'there is nothing good on television',
    'he left his umbrella on the bus', 'how much did the new phone cost',
    'she plays the piano very well', 'they are building a bridge over the river',
    'turn the music down a little', 'what time does the shop close today',
    'i think it is going to rain tomorrow', 'the children are already asleep',
    'can somebody open the window for me', 'we ran out of sugar and flour',
)  # fmt: skip
STOPS = (
    'stop', 'stop it', 'stop now', 'stop moving', 'halt', 'freeze', 'emergency stop',
    'please stop', 'robot stop', 'stop that', 'halt now', 'freeze now',
)  # fmt: skip
VOICES = {
    'flite slt': ['flite', '-voice', 'slt', '-o', '{file}', '-t', '{text}'],
    'flite rms': ['flite', '-voice', 'rms', '-o', '{file}', '-t', '{text}'],
    'flite awb': ['flite', '-voice', 'awb', '-o', '{file}', '-t', '{text}'],
    'espeak en-us': ['espeak-ng', '-v', 'en-us', '-s', '160', '-w', '{file}', '{text}'],
    'espeak en-us+f3': ['espeak-ng', '-v', 'en-us+f3', '-s', '160', '-w', '{file}', '{text}'],
    'espeak en-gb': ['espeak-ng', '-v', 'en-gb', '-s', '150', '-w', '{file}', '{text}'],
}
SAMPLES = {
    'flite slt': (
        'go to the kitchen', 'stop', 'how many books are on the sideboard',
        'the weather is nice today', 'my car needs new brakes',
    ),
    'flite rms': (
        'go to the kitchen', 'stop', 'bring me the red mug from the kitchen',
        'i had pasta for lunch yesterday',
    ),
    'flite awb': ('go to the kitchen', 'stop', 'let us watch a movie later'),
    'espeak en-us': ('please call my mother tonight',),
}  # fmt: skip
"""The samples of the voice_control tests: commands, and sentences that are not commands."""
Steps = tuple[tuple[str, str], ...]
"""The skill and the arguments of each step of a plan, as text."""
DEFINITE = re.compile(r'is_definite=\w+')
SAY = re.compile(r'say (dinner|good)|.* say done')
PEAK = 12_000.0
KINDS_OF_COMMANDS = ('right', 'article', 'wrong', 'rejected')
KINDS_OF_OTHERS = ('taken', 'taken for a stop')
THRESHOLDS = (-2.4, -2.0, -1.8, -1.6, -1.4, -1.2, -1.0, -0.8, -0.6, -0.4)
"""The thresholds of `--roc`."""
ACCEPT_ALL = -100.0
"""A threshold below the ratio of any utterance."""


@dataclass(frozen=True)
class Spotted:
    """What was recognized in a sound with one utterance or several."""

    text: str
    is_accepted: bool
    is_stop: bool
    confidence: float
    """The least confidence of the utterances."""


@dataclass
class Row:
    """Counts of the sentences of a voice by kind, and what was accepted, for the ROC."""

    counts: Counter[str] = field(default_factory=Counter)
    speech_s: float = 0.0
    cpu_s: float = 0.0
    accepted: list[tuple[str, float]] = field(default_factory=list)
    """The kind and the confidence of each sentence that was accepted."""

    def above(self, threshold: float) -> Counter[str]:
        """
        Count the sentences by kind that are accepted above a threshold.

        Parameters
        ----------
        threshold
            The minimum confidence.

        """
        return Counter(kind for kind, confidence in self.accepted if confidence >= threshold)


def main() -> int:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    level = parser.add_mutually_exclusive_group()
    level.add_argument(
        '--snr', type=in_range(float, -20.0, 100.0), metavar='DB',
        help='add white noise at this signal-to-noise ratio (dB) to each sentence: '
        'that of the mean powers of speech without its pauses, and of noise',
    )  # fmt: skip
    level.add_argument(
        '--noise', type=in_range(float, 0.0, 10_000.0), default=10.0,
        help='standard deviation of the noise beside speech with a peak of 12000',
    )  # fmt: skip
    parser.add_argument(
        '--threshold', type=float, default=THRESHOLD, help='that of the recogniser'
    )
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        '--held-out', action='store_true',
        help='the sentences of speech_held_out.yaml, not those of the tests',
    )  # fmt: skip
    which.add_argument(
        '--development', action='store_true', help='the sentences of speech_development.yaml'
    )
    parser.add_argument(
        '--recordings', type=Path, metavar='FOLDER',
        help='keep what was synthesized in a folder, and use what is there already',
    )  # fmt: skip
    parser.add_argument(
        '--every', type=in_range(int, 1), default=1, help='only each n-th sentence'
    )
    parser.add_argument(
        '--roc', action='store_true', help='also count what other thresholds would accept'
    )
    parser.add_argument('--raw', action='store_true', help='without noise suppression')
    parser.add_argument('--list', action='store_true', help='print what was not understood')
    parser.add_argument(
        '--samples', type=Path, metavar='FOLDER',
        help='only write what the tests of voice_control hear into a folder, with its grammar',
    )  # fmt: skip
    parser.add_argument(
        '--whisper', default='', metavar='FOLDER', help='a model for faster-whisper to hear with'
    )
    parser.add_argument(
        '--voice', metavar='COMMAND', type=synthesizer,
        help='the command of another synthesizer, instead of those of the system: '
        "'piper -m FOLDER/voice.onnx -f {file} -- {text}'",
    )  # fmt: skip
    options = parser.parse_args()
    voices = {name: words for name, words in VOICES.items() if shutil.which(words[0])}
    if options.voice:
        voices = {Path(options.voice[0]).name: options.voice}
    if not voices:
        print('There is no synthesizer: sudo apt install flite espeak-ng', file=sys.stderr)
        return 1
    planner, world = apartment()
    if options.samples:
        write_samples(options.samples, planner.to_jsgf(world))
        return 0
    commands, others = of_tests(), OTHER
    if options.held_out or options.development:
        name = 'held_out' if options.held_out else 'development'
        commands, others = written_in(Path(__file__).with_name(f'speech_{name}.yaml'))
    commands, others = commands[:: options.every], others[:: options.every]
    try:
        suppress = None if options.raw else NoiseSuppressor().suppress
        whisper = FasterWhisper(options.whisper) if options.whisper else None
    except UserError as error:
        parser.error(str(error))
    threshold = ACCEPT_ALL if options.roc else options.threshold
    grammar = GrammarRecognizer(threshold, suppress=suppress)
    listener = Listener(grammar, whisper)
    unknown = listener.set_grammar(planner.to_jsgf(world))
    print(f'{len(commands)} commands, {len(others)} others; unknown words: {unknown or "none"}')
    print(
        f'{"voice":<18}{"right":>7}{"article":>9}{"wrong":>7}{"rejected":>10}{"others taken":>14}'
        f'{"for a stop":>12}{"stops":>7}{"CPU":>7}'
    )
    for name, words in voices.items():
        row = measured(words, commands, others, planner, world, listener, options)
        shares = [row.counts[kind] / len(commands) for kind in KINDS_OF_COMMANDS]
        shares += [row.counts[kind] / len(others) for kind in KINDS_OF_OTHERS]
        shares.append(row.counts['stop'] / len(STOPS))
        print(
            f'{name:<18}{shares[0]:>7.0%}{shares[1]:>9.0%}{shares[2]:>7.0%}{shares[3]:>10.0%}'
            f'{shares[4]:>14.0%}{shares[5]:>12.0%}{shares[6]:>7.0%}'
            f'{row.cpu_s / row.speech_s:>7.3f}'
        )
        for threshold in THRESHOLDS if options.roc else ():
            counts = row.above(threshold)
            right, article = (counts[kind] / len(commands) for kind in ('right', 'article'))
            taken, stop = (counts[kind] / len(others) for kind in KINDS_OF_OTHERS)
            print(f'{threshold:>18.1f}{right:>7.0%}{article:>9.0%}{taken:>31.0%}{stop:>12.0%}')
    return 0


def of_tests() -> Sequence[str]:
    """Return the commands of the planner's tests, but for free text: no grammar can have that."""
    said = yaml.safe_load((TESTS / 'sentences.yaml').read_text())
    return [text for kind in KINDS for text in said[kind] if not SAY.match(text)]


def written_in(path: Path) -> tuple[Sequence[str], Sequence[str]]:
    """
    Return the commands and the other sentences of a file.

    Parameters
    ----------
    path
        A YAML file with the lists `commands` and `others`.

    """
    said = yaml.safe_load(path.read_text())
    return said['commands'], said['others']


def synthesizer(text: str) -> list[str]:
    """
    Split the command of a synthesizer into words, for argparse.

    Parameters
    ----------
    text
        The command, with `{file}` and `{text}` to be filled in.

    Raises
    ------
    argparse.ArgumentTypeError
        It is no command, has other words in braces, or its program is not there.

    """
    try:
        words = shlex.split(text)
        _ = [word.format(file='', text='') for word in words]
    except (ValueError, LookupError) as error:
        raise argparse.ArgumentTypeError(f'{text!r} is no command: {error}') from None
    if '{file}' not in text or '{text}' not in text:
        raise argparse.ArgumentTypeError(f'{text!r} needs the words {{file}} and {{text}}')
    if not shutil.which(words[0]):
        raise argparse.ArgumentTypeError(f'there is no program {words[0]!r}')
    return words


def measured(
    words: list[str], commands: Sequence[str], others: Sequence[str], planner: RulePlanner,
    world: World, listener: Listener, options: argparse.Namespace,
) -> Row:  # fmt: skip
    """
    Synthesize all sentences with a voice, recognize them, and count the results.

    Parameters
    ----------
    words
        The command of the voice, one of `VOICES`.
    commands
        The sentences that are commands; `STOPS` follow.
    others
        Those that are not.
    planner, world
        Decide whether two sentences mean the same.
    listener
        The recogniser to measure.
    options
        The command line: `snr`, `noise`, `recordings` and `list`.

    """
    row = Row()
    for number, text in enumerate([*commands, *others, *STOPS]):
        sound = spoken(words, text, options, number)
        begin_s = time.process_time()
        heard = recognized(listener, sound)
        row.cpu_s += time.process_time() - begin_s
        row.speech_s += duration_s(sound)
        kind = kind_of(text, heard, planner, world, is_other=text in others)
        row.counts[kind] += 1
        if kind not in ('rejected', 'left', 'missed'):
            row.accepted.append((kind, math.inf if heard.is_stop else heard.confidence))
        if options.list and kind not in ('right', 'left', 'stop'):
            print(f'    {kind}: {text!r} -> {heard.text!r} ({heard.confidence:.2f})')
    return row


def kind_of(
    text: str, heard: Spotted, planner: RulePlanner, world: World, *, is_other: bool
) -> str:
    """
    Classify what was recognized.

    Parameters
    ----------
    text
        The sentence that was spoken.
    heard
        What was recognized.
    planner, world
        Decide whether two sentences mean the same.
    is_other
        Whether the sentence is not a command.

    Returns
    -------
    str
        One of `KINDS_OF_COMMANDS`; for other sentences one of `KINDS_OF_OTHERS`, or `left`; for a
        stop `stop` or `missed`.

    """
    if text in STOPS:
        return 'stop' if heard.is_stop else 'missed'
    outcome = plan_of(planner, world, heard.text) if heard.is_accepted else None
    if is_other:
        if outcome is None:
            return 'left'
        return 'taken for a stop' if heard.is_stop else 'taken'
    if outcome is None:
        return 'rejected'
    wanted = plan_of(planner, world, text)
    if outcome == wanted:
        return 'right'
    return 'article' if without_articles(outcome) == without_articles(wanted) else 'wrong'


def without_articles(steps: Steps | None) -> Steps | None:
    """
    Remove from a plan whether its objects are particular ones or any.

    Parameters
    ----------
    steps
        The plan, from `plan_of`.

    """
    if steps is None:
        return None
    return tuple((skill, DEFINITE.sub('', arguments)) for skill, arguments in steps)


def spoken(words: list[str], text: str, options: argparse.Namespace, seed: int) -> bytes:
    """
    Synthesize a sentence with silence and noise around it.

    Parameters
    ----------
    words
        The command of the voice.
    text
        The sentence.
    options
        The command line: `snr`, `noise` and `recordings`.
    seed
        The seed of the noise.

    Returns
    -------
    bytes
        Samples in S16LE, 16 kHz, mono.

    """
    speech = recorded(words, text, options.recordings)
    noise = options.noise
    if options.snr is not None:
        noise = speech_level(speech) * 10.0 ** (-options.snr / 20.0)
    samples = np.concatenate([np.zeros(8000), speech, np.zeros(16_000)])
    samples += np.random.default_rng(seed).normal(0.0, noise, samples.size)
    return s16le(samples)


def speech_level(samples: NDArray[np.float64]) -> float:
    """
    Compute the root mean square of speech without its pauses.

    Parameters
    ----------
    samples
        Samples (n,) at 16 kHz. Pauses are 20 ms with 40 dB less than the loudest 20 ms.

    """
    size = RATE_HZ // 50
    frames = np.resize(samples, (max(samples.size // size, 1), size))
    powers = (frames**2).mean(axis=1)
    return math.sqrt(powers[powers >= powers.max() * 1e-4].mean())


def recorded(words: list[str], text: str, folder: Path | None) -> NDArray[np.float64]:
    """
    Read the recording of a sentence from a folder, or synthesize it and keep it there.

    Parameters
    ----------
    words
        The command of the voice.
    text
        The sentence.
    folder
        The folder; None to keep nothing.

    Returns
    -------
    NDArray
        As of `synthesized`.

    """
    if folder is None:
        return synthesized(words, text)
    voice = crc32(' '.join(words).encode())
    path = folder / f'{re.sub("[^a-z0-9]+", "_", text.lower())}.{voice:08x}.wav'
    if not path.exists():
        folder.mkdir(parents=True, exist_ok=True)
        path.write_bytes(wav_of(s16le(synthesized(words, text))))
    return np.frombuffer(read_wav(path), '<i2').astype(np.float64)


def synthesized(words: list[str], text: str) -> NDArray[np.float64]:
    """
    Synthesize a sentence with a voice, with a peak of `PEAK`.

    Parameters
    ----------
    words
        The command of the voice, with `{file}` and `{text}` to be filled in.
    text
        The sentence.

    Returns
    -------
    NDArray
        Samples (n,) at 16 kHz, in steps of 16-bit samples.

    """
    with TemporaryDirectory() as folder:
        file = f'{folder}/speech.wav'
        command = [word.format(file=file, text=text) for word in words]
        done = subprocess.run(command, check=False, capture_output=True, text=True)
        try:
            samples = np.frombuffer(read_wav(Path(file)), '<i2').astype(float)
        except AudioError as error:
            sys.exit(f'{words[0]} ended with status {done.returncode}: {error} {done.stderr}')
    return samples * (PEAK / max(np.abs(samples).max(), 1.0))


def s16le(samples: NDArray[np.float64]) -> bytes:
    """
    Convert samples to bytes in S16LE, clipped to 16 bits.

    Parameters
    ----------
    samples
        The samples (n,), in steps of 16-bit samples.

    """
    return np.clip(samples, -32768, 32767).astype('<i2').tobytes()


def write_samples(folder: Path, grammar: str) -> None:
    """
    Write the sentences of `SAMPLES` and their grammar; files are named by text and voice.

    Parameters
    ----------
    folder
        The folder of the samples.
    grammar
        The commands in JSGF.

    """
    folder.mkdir(parents=True, exist_ok=True)
    (folder / 'robot.jsgf').write_text(grammar)
    for voice, texts in SAMPLES.items():
        for text in texts:
            kind = '' if text not in OTHER else 'other_'
            name = f'{kind}{text.replace(" ", "_")}.{voice.split()[-1]}.wav'
            (folder / name).write_bytes(wav_of(s16le(synthesized(VOICES[voice], text))))


def recognized(listener: Listener, sound: bytes) -> Spotted:
    """
    Segment a sound into utterances and recognize them.

    Parameters
    ----------
    listener
        The recogniser.
    sound
        Samples in S16LE, 16 kHz, mono.

    Returns
    -------
    Spotted
        The words of all utterances; they are accepted if all utterances are, and a stop if any is.

    """
    segmenter = UtteranceSegmenter()
    found = []
    for piece in chunks(sound, 0.03):
        for utterance in segmenter.add(piece):
            found.append(listener.hear(utterance).recognition)
    return Spotted(
        ' '.join(each.text for each in found),
        bool(found) and all(each.is_accepted for each in found),
        any(each.is_stop for each in found),
        min((each.confidence for each in found), default=-math.inf),
    )


def plan_of(planner: RulePlanner, world: World, text: str) -> Steps | None:
    """
    Plan a sentence, in a form in which plans can be compared.

    Parameters
    ----------
    planner
        The rule-based planner.
    world
        Its world model.
    text
        The sentence.

    Returns
    -------
    tuple or None
        Skill and arguments of each step; None if there is no plan.

    """
    outcome = planner.plan(text, world, Dialogue())
    if isinstance(outcome, Plan):
        return tuple((step.skill, repr(step.arguments)) for step in outcome.steps)
    return None


if __name__ == '__main__':
    sys.exit(main())
