# SPDX-License-Identifier: Apache-2.0
"""Recognize commands in audio: the node `speech_recognizer`."""

from __future__ import annotations

from collections.abc import Callable
import math
import os
from queue import Queue
import sys
import threading
import time
import traceback
from typing import Any

from audio_common_msgs.msg import AudioData
from humanoid_common.diagnostics import Diagnostics, PartStatus
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.paths import expanded_path
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.running import run_node
from humanoid_interfaces.msg import SpeechResult
from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool
from voice_control.grammar_recognizer import GrammarRecognizer, read_dictionary
from voice_control.noise_suppression import NoiseSuppressionError, NoiseSuppressor
from voice_control.recognition import (
    FreeRecognizer,
    Heard,
    Listener,
    Recognizer,
    RecognizerError,
)
from voice_control.recognizer_parameters import (
    OPENAI,
    POCKETSPHINX,
    RecognizerParameters,
    WHISPER,
    WHISPER_CPP,
)
from voice_control.segmentation import UtteranceSegmenter
from voice_control.whisper import FasterWhisper, TranscriptionServer, WhisperCpp

__all__ = ['SpeechRecognizer', 'main']

_LONGEST_QUEUE = 400
"""How many pieces of sound wait for the worker thread at most; what is no sound always waits."""
_END_S = 2.0
_ECHO_S = 0.3
"""How long after its own speech the robot does not listen."""
_SILENT_AFTER_S = 5.0
_EARLY_S = 15.0
"""How long an utterance that precedes the first grammar is kept to be recognized with it."""
Work = Callable[[], None]


def make_listener(
    told: RecognizerParameters, report: Callable[[str], None]
) -> tuple[Listener, Recognizer]:
    """
    Create the listener that the parameters configure.

    Parameters
    ----------
    told
        The parameters.
    report
        Called with a message when a part fails.

    Returns
    -------
    Listener, Recognizer
        The listener, and its recogniser of everything but "stop".

    Raises
    ------
    UserError
        If a configured part cannot be used.

    """
    dictionary = {}
    if told.dictionary_file:
        try:
            text = expanded_path(told.dictionary_file).read_text(encoding='utf-8')
        except (OSError, UnicodeDecodeError) as error:
            raise RecognizerError(f"'{told.dictionary_file}' cannot be read: {error}") from error
        dictionary = read_dictionary(text.splitlines())
    suppress = None
    if told.noise_suppression:
        try:
            suppress = NoiseSuppressor().suppress
        except NoiseSuppressionError as error:
            report(f'Noise is not suppressed. {error}')
    grammar = GrammarRecognizer(told.threshold, dictionary, suppress)
    other: FreeRecognizer | None = None
    if told.backend == WHISPER:
        other = FasterWhisper(told.model_path, told.language, told.num_threads)
    elif told.backend == WHISPER_CPP:
        other = WhisperCpp(told.model_path, told.language, told.num_threads)
    elif told.backend == OPENAI:
        key = os.environ.get('OPENAI_API_KEY', '')
        other = TranscriptionServer(told.base_url, told.model, key, told.language)
    return Listener(grammar, other, told.wake_word, report), other or grammar


class SpeechRecognizer(Node):
    """
    Node that recognizes speech on `audio`.

    Commands are published on `speech/transcript`, and all results on `speech/result`. The API key
    of a server is read from the environment variable OPENAI_API_KEY.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    Raises
    ------
    UserError
        If a configured part cannot be used.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('speech_recognizer', **options)
        told = NodeParameters(self, RecognizerParameters).current
        self._listener, main = make_listener(told, self._report)
        self._title, self._language = main.title, told.language
        self._segmenter = UtteranceSegmenter(told.vad_mode, told.max_utterance_s)
        self._is_enabled, self._is_speaking = True, False
        self._quiet_until_s = 0.0
        self._sound_s = -math.inf
        self._heard = self._accepted = self._lost = 0
        self._early: list[tuple[float, bytes]] = []
        self._transcripts = self.create_publisher(String, 'speech/transcript', EVENT)
        self._results = self.create_publisher(SpeechResult, 'speech/result', EVENT)
        self.create_subscription(AudioData, 'audio', self._take, EVENT)
        self.create_subscription(String, 'speech/grammar', self._take_grammar, LATCHED)
        self.create_subscription(Bool, 'speech/speaking', self._mute, LATCHED)
        self.create_service(SetBool, '~/enable', self._enable)
        self._diagnostics = Diagnostics(self, self._status)
        self._queue: Queue[Work | None] = Queue()
        self._worker = threading.Thread(target=self._work, name='recognizer', daemon=True)
        self._worker.start()
        self.get_logger().info(f'Recognizing speech with {self._title}.')

    def destroy_node(self) -> None:
        """Also end the worker thread."""
        self._is_enabled = False
        self._queue.put(None)
        self._worker.join(_END_S)  # it is a daemon if it takes longer
        super().destroy_node()

    # Input

    def _take(self, message: AudioData) -> None:
        now_s = self._sound_s = time.monotonic()
        if self._is_enabled and not self._is_speaking and now_s >= self._quiet_until_s:
            sound = message.data.tobytes()
            if self._queue.qsize() < _LONGEST_QUEUE:
                self._queue.put(lambda: self._add(sound))
            else:
                self._lose()

    def _lose(self) -> None:
        """Count sound for which the worker thread is too far behind."""
        self._lost += 1
        self.get_logger().warning(
            'Speech arrives faster than it can be recognized: some of it is lost.',
            throttle_duration_sec=10.0,
        )

    def _take_grammar(self, message: String) -> None:
        self._queue.put(lambda: self._set_grammar(message.data))

    def _mute(self, message: Bool) -> None:
        """Suspend recognition while the robot itself speaks."""
        if self._is_speaking and not message.data:
            self._quiet_until_s = time.monotonic() + _ECHO_S
        self._is_speaking = message.data
        self._queue.put(self._segmenter.reset)

    def _enable(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self._is_enabled = request.data
        self._queue.put(self._segmenter.reset)
        if not request.data:
            self._queue.put(self._early.clear)  # nobody expects it to be obeyed later
        response.success = True
        response.message = 'listening' if request.data else 'not listening'
        return response

    # Worker thread

    def _work(self) -> None:
        while (work := self._queue.get()) is not None:
            try:
                work()
            except Exception:  # an error in one utterance must not affect the next
                self.get_logger().error(traceback.format_exc())

    def _add(self, sound: bytes) -> None:
        for utterance in self._segmenter.add(sound):
            heard = self._listener.hear(utterance)
            if heard.recognition.is_stop:
                self._early.clear()  # it also cancels what was said before
            elif not self._listener.is_ready:
                now_s = time.monotonic()
                recent = [each for each in self._early if now_s - each[0] < _EARLY_S]
                self._early[:] = [*recent, (now_s, utterance)]
            self._hand_over(heard)

    def _hand_over(self, heard: Heard) -> None:
        """Publish a recognition in the thread of the executor."""
        executor = self.executor
        if executor is not None:
            executor.create_task(self._tell, heard)

    def _set_grammar(self, jsgf: str) -> None:
        try:
            unknown = self._listener.set_grammar(jsgf)
        except RecognizerError as error:
            self._report(f'{error} Still using the previous grammar.')
            return
        if unknown:
            words = ', '.join(f'"{word}"' for word in unknown)
            self._report(
                f'The pronunciation of {words} is unknown, so it cannot be recognized: add it to '
                'a dictionary file, and set dictionary_file to its path.'
            )
        early = self._early.copy()
        self._early.clear()
        for said_s, utterance in early:
            if time.monotonic() - said_s < _EARLY_S:
                self._hand_over(self._listener.hear(utterance))

    def _report(self, sentence: str) -> None:
        self.get_logger().warning(sentence)

    # Output

    def _tell(self, heard: Heard) -> None:
        recognition = heard.recognition
        self._heard += 1
        result = SpeechResult(
            text=recognition.text,
            accepted=recognition.is_accepted,
            reason=recognition.reason,
            confidence=recognition.confidence if math.isfinite(recognition.confidence) else 0.0,
            backend=recognition.backend,
            locale='en-US' if recognition.backend == POCKETSPHINX else self._language,
            speech_duration=Duration(seconds=heard.speech_s).to_msg(),
            processing_duration=Duration(seconds=heard.processing_s).to_msg(),
        )
        result.header.stamp = self.get_clock().now().to_msg()
        self._results.publish(result)
        if recognition.is_accepted and recognition.text:
            self._accepted += 1
            self.get_logger().info(f'Heard: {recognition.text!r}')
            self._transcripts.publish(String(data=recognition.text))

    def _status(self) -> list[PartStatus]:
        """Return the diagnostic status of the node."""
        is_silent = time.monotonic() - self._sound_s > _SILENT_AFTER_S
        values = {
            'recogniser': self._title,
            'utterances': self._heard,
            'accepted': self._accepted,
            'lost audio chunks': self._lost,
        }
        words = 'No audio received' if is_silent else 'Listening'
        return [PartStatus('speech', words, values=values)]


def main(args: list[str] | None = None) -> int:
    """
    Run the node `speech_recognizer`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(SpeechRecognizer, args)


if __name__ == '__main__':
    sys.exit(main())
