# SPDX-License-Identifier: Apache-2.0
"""The nodes over DDS: a file is heard, the robot does not hear itself, and nothing else falls."""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from pathlib import Path
import sys
import time
from typing import Any

from audio_common_msgs.msg import AudioData, AudioInfo
from humanoid_common.errors import UserError
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.msg import SpeechResult
import pytest
from rclpy.node import Node
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool
from voice_control import speech_recognizer
from voice_control.audio import chunks, read_wav
from voice_control.audio_source import AudioSource
from voice_control.noise_suppression import NoiseSuppressionError
from voice_control.recognizer_parameters import RecognizerParameters
from voice_control.speaker import Speaker
from voice_control.speech_recognizer import make_listener, SpeechRecognizer

SPEECH = Path(__file__).parent / 'speech'
GO_TO_THE_KITCHEN = SPEECH / 'go_to_the_kitchen.slt.wav'
STOP = SPEECH / 'stop.slt.wav'
GRAMMAR = """#JSGF V1.0;
grammar robot;
public <command> = go to the (<place>) | <stop>;
<place> = kitchen | hall | desk | xyzzyqux;
<stop> = stop [moving];
"""


class Ear(Node):
    """What hears the results, and speaks into the microphone."""

    def __init__(self, **options: Any) -> None:
        super().__init__('ear', **options)
        self.transcripts: list[str] = []
        self.results: list[SpeechResult] = []
        self.infos: list[AudioInfo] = []
        self.sounds: list[bytes] = []
        self.speaking: list[bool] = []
        self.create_subscription(
            String, 'speech/transcript', lambda each: self.transcripts.append(each.data), EVENT
        )
        self.create_subscription(SpeechResult, 'speech/result', self.results.append, EVENT)
        self.create_subscription(
            Bool, 'speech/speaking', lambda each: self.speaking.append(each.data), LATCHED
        )
        self.create_subscription(AudioInfo, 'audio_info', self.infos.append, LATCHED)
        self.grammar = self.create_publisher(String, 'speech/grammar', LATCHED)
        self.audio = self.create_publisher(AudioData, 'audio', EVENT)
        self.mute = self.create_publisher(Bool, 'speech/speaking', LATCHED)
        self.say = self.create_publisher(String, 'speech/say', EVENT)

    def listen(self) -> None:
        """Hear the sound, too."""
        self.create_subscription(
            AudioData, 'audio', lambda each: self.sounds.append(each.data.tobytes()), EVENT
        )

    def speak(self, path: Path) -> None:
        """Publish a file with silence behind it, as fast as it goes."""
        for piece in chunks(bytes(8000) + read_wav(path) + bytes(48_000), 0.1):
            self.audio.publish(AudioData(data=array('B', piece)))


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


@pytest.fixture
def ear(ros: RosSandbox) -> Ear:
    """Start what hears the results."""
    return ros.start(Ear)


@pytest.fixture
def recognizer(ros: RosSandbox, ear: Ear) -> SpeechRecognizer:
    """Start a recogniser of a small grammar."""
    ear.grammar.publish(String(data=GRAMMAR))
    node = ros.start(SpeechRecognizer)
    ros.wait_until(lambda: ear.audio.get_subscription_count() == 1, what='the recogniser')
    ros.wait_until(lambda: ear.count_publishers('speech/result') == 1, what='its results')
    ros.wait_until(lambda: node._listener.is_ready, what='the grammar')
    speak_until(ros, ear, GO_TO_THE_KITCHEN, 'go to the kitchen')
    ear.transcripts.clear()
    ear.results.clear()
    return node


def speak_until(ros: RosSandbox, ear: Ear, path: Path, text: str) -> None:
    """Speak again and again until something is understood: the grammar may still be coming."""
    for _ in range(5):
        ear.speak(path)
        count = len(ear.results)
        ros.wait_until(lambda count=count: len(ear.results) > count, what='a result')
        if any(each.accepted and each.text == text for each in ear.results):
            ros.wait_until(lambda: text in ear.transcripts, what='the transcript')
            return
    pytest.fail(f'{text!r} is not in {ear.transcripts}; {[each.text for each in ear.results]}')


def test_without_noise_suppression(monkeypatch: pytest.MonkeyPatch) -> None:
    """A missing library is reported, and speech is recognized all the same."""

    def fail() -> None:
        raise NoiseSuppressionError('There is no library.')

    monkeypatch.setattr(speech_recognizer, 'NoiseSuppressor', fail)
    told: list[str] = []
    listener, _ = make_listener(RecognizerParameters(), told.append)
    assert told == ['Noise is not suppressed. There is no library.']
    assert listener.set_grammar(GRAMMAR) == ['xyzzyqux']
    make_listener(RecognizerParameters(noise_suppression=False), told.append)
    assert len(told) == 1


def test_speech_becomes_a_command(ros: RosSandbox, ear: Ear, recognizer: SpeechRecognizer) -> None:
    """What is accepted is a transcript, and the result says how it came about."""
    ear.speak(GO_TO_THE_KITCHEN)
    ros.wait_until(lambda: ear.transcripts, what='a transcript')
    assert ear.transcripts == ['go to the kitchen']
    [result] = ear.results
    assert (result.text, result.accepted, result.backend) == (
        'go to the kitchen', True, 'pocketsphinx',
    )  # fmt: skip
    assert 0.5 < result.speech_duration.sec + result.speech_duration.nanosec * 1e-9 < 4.0


@pytest.mark.parametrize('spoken', [[GO_TO_THE_KITCHEN], [GO_TO_THE_KITCHEN, STOP]])
def test_what_was_said_before_the_grammar_came(
    ros: RosSandbox, ear: Ear, spoken: list[Path]
) -> None:
    """It is recognized then, unless the robot was told to stop in the meantime."""
    ros.start(SpeechRecognizer)
    ros.wait_until(lambda: ear.audio.get_subscription_count() == 1, what='the recogniser')
    ros.wait_until(lambda: ear.count_publishers('speech/result') == 1, what='its results')
    for number, path in enumerate(spoken, start=1):
        ear.speak(path)
        ros.wait_until(lambda number=number: len(ear.results) == number, what='a result')
    assert ear.results[0].reason.startswith('Only "stop" is recognized')
    ear.grammar.publish(String(data=GRAMMAR))
    if spoken == [GO_TO_THE_KITCHEN]:
        ros.wait_until(lambda: ear.transcripts == ['go to the kitchen'], what='the command')
    else:
        ros.wait_until(lambda: ear.grammar.get_subscription_count() == 1, what='the grammar')
        speak_until(ros, ear, STOP, 'stop')
        assert set(ear.transcripts) == {'stop'}


def test_what_was_said_before_it_was_switched_off(ros: RosSandbox, ear: Ear) -> None:
    """It is not obeyed when a grammar comes later."""
    node = ros.start(SpeechRecognizer)
    ros.wait_until(lambda: ear.audio.get_subscription_count() == 1, what='the recogniser')
    ros.wait_until(lambda: ear.count_publishers('speech/result') == 1, what='its results')
    ear.speak(GO_TO_THE_KITCHEN)
    ros.wait_until(lambda: len(ear.results) == 1, what='a result')
    switch = ear.create_client(SetBool, 'speech_recognizer/enable')
    ros.wait_until(switch.service_is_ready, what='the service')
    for is_on in (False, True):
        called = switch.call_async(SetBool.Request(data=is_on))
        ros.wait_until(called.done, what='an answer')
    ear.grammar.publish(String(data=GRAMMAR))
    ros.wait_until(lambda: node.count_publishers('speech/grammar') == 1, what='the grammar')
    speak_until(ros, ear, STOP, 'stop')
    assert set(ear.transcripts) == {'stop'}


def test_a_grammar_is_taken_while_sound_is_lost(
    ros: RosSandbox, ear: Ear, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is published only once, so that nothing would be recognized any more."""
    monkeypatch.setattr(speech_recognizer, '_LONGEST_QUEUE', 0)
    node = ros.start(SpeechRecognizer)
    ear.grammar.publish(String(data=GRAMMAR))
    ros.wait_until(lambda: node._listener.is_ready, what='the grammar')


def test_the_robot_does_not_hear_itself(
    ros: RosSandbox, ear: Ear, recognizer: SpeechRecognizer
) -> None:
    """What comes while it speaks is not heard; afterwards it listens again."""
    ear.mute.publish(Bool(data=True))
    ros.wait_until(lambda: recognizer._is_speaking, what='silence')
    ear.speak(STOP)
    ear.mute.publish(Bool(data=False))
    ros.wait_until(lambda: not recognizer._is_speaking, what='listening')
    began_s = time.monotonic()
    ros.wait_until(lambda: time.monotonic() > began_s + 0.5, what='the end of the echo')
    speak_until(ros, ear, GO_TO_THE_KITCHEN, 'go to the kitchen')
    assert 'stop' not in ear.transcripts


def test_it_can_be_switched_off(ros: RosSandbox, ear: Ear, recognizer: SpeechRecognizer) -> None:
    """By a service; after that it hears again."""
    client = ear.create_client(SetBool, 'speech_recognizer/enable')
    for value in (False, True):
        ros.wait_until(client.service_is_ready, what='the service')
        called = client.call_async(SetBool.Request(data=value))
        ros.wait_until(called.done, what='an answer')
        assert called.result().success
        ear.speak(GO_TO_THE_KITCHEN if value else STOP)
    ros.wait_until(lambda: ear.transcripts, what='a transcript')
    assert 'stop' not in ear.transcripts


def test_a_file_is_played(ros: RosSandbox, ear: Ear) -> None:
    """As a microphone would, in real time, with silence around it."""
    ear.listen()
    ros.start(AudioSource, {'source': 'file', 'wav_file': str(STOP)})
    sound = read_wav(STOP)
    ros.wait_until(lambda: sound in b''.join(ear.sounds), what='the sound')
    assert ear.infos[0].sample_rate == 16_000
    assert (ear.infos[0].channels, ear.infos[0].sample_format) == (1, 'S16LE')


@pytest.mark.parametrize(
    ('parameters', 'reason'),
    [
        ({'source': 'file'}, 'set wav_file'),
        ({'source': 'file', 'wav_file': '/no/where.wav'}, 'No such file'),
        ({'source': 'file', 'wav_file': __file__}, 'is not a WAV file'),
        ({'source': 'file', 'wav_file': '~no_one/a.wav'}, "no home folder '~no_one'"),
    ],
)
def test_a_file_that_cannot_be_played(
    ros: RosSandbox, parameters: dict[str, str], reason: str
) -> None:
    """The node does not start, and says why."""
    with pytest.raises(UserError, match=reason):
        ros.start(AudioSource, parameters)


@pytest.mark.parametrize('source', ['auto', 'microphone'])
def test_no_microphone(
    ros: RosSandbox, ear: Ear, monkeypatch: pytest.MonkeyPatch, source: str
) -> None:
    """The node goes on, and what is typed is obeyed all the same."""
    monkeypatch.setitem(sys.modules, 'sounddevice', None)
    node = ros.start(AudioSource, {'source': source})
    ros.wait_until(lambda: ear.infos, what='the node')
    assert 'sounddevice' in node._complaint
    node._listen()  # as the timer does


@pytest.mark.parametrize(
    ('parameters', 'reason'),
    [
        ({'backend': 'whisper'}, 'set model_path'),
        ({'backend': 'whisper', 'model_path': '/no/where'}, 'not found'),
        ({'backend': 'whisper', 'model_path': '~no_one/m'}, "no home folder '~no_one'"),
        ({'backend': 'openai'}, 'not a valid server address'),
        ({'dictionary_file': '/no/where'}, 'cannot be read'),
        ({'dictionary_file': '~no_one/words'}, "no home folder '~no_one'"),
    ],
)
def test_a_recogniser_that_cannot_start(
    ros: RosSandbox, parameters: dict[str, str], reason: str
) -> None:
    """One sentence says why."""
    with pytest.raises(UserError, match=reason):
        ros.start(SpeechRecognizer, parameters)


@pytest.mark.parametrize('grammar', ['', 'nonsense', '#JSGF V1.0; grammar x; public <a> = (b;'])
def test_a_grammar_that_cannot_be_used(
    ros: RosSandbox, ear: Ear, recognizer: SpeechRecognizer, grammar: str
) -> None:
    """The one of before is used on."""
    ear.grammar.publish(String(data=grammar))
    ear.speak(GO_TO_THE_KITCHEN)
    ros.wait_until(lambda: ear.transcripts, what='a transcript')
    assert ear.transcripts == ['go to the kitchen']


@pytest.fixture
def program(tmp_path: Path) -> Path:
    """Return a program that speaks into a file."""
    path = tmp_path / 'speak'
    path.write_text(
        f'#!/bin/sh\necho "$@" > {tmp_path}/options\ncat >> {tmp_path}/spoken\n'
        f'echo >> {tmp_path}/spoken\nsleep 0.2\n'
    )
    path.chmod(0o755)
    return path


def test_texts_are_spoken_in_turn(ros: RosSandbox, ear: Ear, program: Path) -> None:
    """One after another, as text and not as options; meanwhile it says that it speaks."""
    ros.start(Speaker, {'program': str(program), 'words_per_minute': 120})
    ros.wait_until(lambda: ear.say.get_subscription_count() == 1, what='the speaker')
    for text in ('--help', 'I have stopped.', '   '):
        ear.say.publish(String(data=text))
    spoken = program.with_name('spoken')
    ros.wait_until(
        lambda: spoken.exists() and spoken.read_text() == '--help\nI have stopped.\n',
        what='what is spoken',
    )
    ros.wait_until(lambda: ear.speaking[-1:] == [False], what='the end')
    assert True in ear.speaking
    assert program.with_name('options').read_text() == '-v en-us -s 120 --stdin\n'


def test_a_program_that_fails(ros: RosSandbox, ear: Ear, tmp_path: Path) -> None:
    """The robot goes on, and does not seem to speak for ever."""
    path = tmp_path / 'fails'
    path.write_text('#!/bin/sh\necho no card >&2\nexit 1\n')
    path.chmod(0o755)
    ros.start(Speaker, {'program': str(path)})
    ros.wait_until(lambda: ear.say.get_subscription_count() == 1, what='the speaker')
    ear.say.publish(String(data='Hello.'))
    ros.wait_until(lambda: ear.speaking[-2:] == [True, False], what='the end')


def test_no_program(ros: RosSandbox, ear: Ear) -> None:
    """It is not there, so the robot is silent."""
    ros.start(Speaker, {'program': 'no-such-program'})
    ros.wait_until(lambda: ear.speaking == [False], what='the speaker')
