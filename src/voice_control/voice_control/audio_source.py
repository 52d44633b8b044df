# SPDX-License-Identifier: Apache-2.0
"""Publish audio from a microphone or a file: the node `audio_source`."""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from dataclasses import dataclass
import sys
from typing import Any

from audio_common_msgs.msg import AudioData, AudioInfo
from humanoid_common.errors import UserError
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.paths import expanded_path
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.running import run_node
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from voice_control.audio import AudioError, BYTES_PER_SECOND, chunks, RATE_HZ, read_wav
from voice_control.microphone import Microphone

__all__ = ['AudioSource', 'AudioSourceParameters', 'main']

AUTO, MICROPHONE, FILE, NONE = 'auto', 'microphone', 'file', 'none'
_RETRY_S = 5.0
_SILENCE_S = 1.0
"""Length of the silence before and after a file."""


@dataclass(frozen=True)
class AudioSourceParameters:
    """The parameters of the node."""

    source: str = parameter(
        AUTO,
        'The audio source: a microphone, a WAV file, or none; auto is a microphone if there is '
        'one.',
        choices=(AUTO, MICROPHONE, FILE, NONE),
        read_only=True,
    )
    device: str = parameter(
        '',
        'The microphone: part of its name, or its number; empty for the default device.',
        read_only=True,
    )
    wav_file: str = parameter('', 'The file to play, as a microphone would.', read_only=True)
    loop: bool = parameter(False, 'Play the file in a loop.', read_only=True)
    chunk_s: float = parameter(
        0.03, 'The length of an audio chunk (s).', at_least=0.01, at_most=1.0, read_only=True
    )


class AudioSource(Node):
    """
    Node that publishes audio on `audio`: 16 kHz, mono, S16LE.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    Raises
    ------
    UserError
        If the file cannot be played.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('audio_source', **options)
        self._told = NodeParameters(self, AudioSourceParameters).current
        self._sound = self.create_publisher(AudioData, 'audio', EVENT)
        info = AudioInfo(
            channels=1, sample_rate=RATE_HZ, sample_format='S16LE', coding_format='wave',
            bitrate=8 * BYTES_PER_SECOND,
        )  # fmt: skip
        self._info = self.create_publisher(AudioInfo, 'audio_info', LATCHED)
        self._info.publish(info)
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._microphone: Microphone | None = None
        self._complaint, self._is_over = '', False
        if self._told.source == FILE:
            self._pieces = self._file()
            self.create_timer(self._told.chunk_s, self._play, clock=self._steady)
        elif self._told.source != NONE:
            self.create_timer(_RETRY_S, self._listen, clock=self._steady)
            self._listen()

    def destroy_node(self) -> None:
        """Also close the microphone."""
        if self._microphone is not None:
            self._microphone.close()
        super().destroy_node()

    # A file

    def _file(self) -> Iterator[bytes]:
        if not self._told.wav_file:
            raise UserError('source:=file needs a file: set wav_file:=/path/to/speech.wav')
        sound = read_wav(expanded_path(self._told.wav_file))
        silence = b'\0' * int(_SILENCE_S * RATE_HZ) * 2
        return chunks(silence + sound + silence, self._told.chunk_s)

    def _play(self) -> None:
        """Publish the next chunk, once there is a subscriber."""
        if not self._sound.get_subscription_count():
            return
        piece = next(self._pieces, None)
        if piece is None and self._told.loop:
            self._pieces = self._file()
            piece = next(self._pieces)
        if piece is not None:
            self._publish(piece)
        elif not self._is_over:
            self._is_over = True
            self.get_logger().info(f"'{self._told.wav_file}' has been played.")

    # A microphone

    def _listen(self) -> None:
        """Open the microphone unless it is open; it may be plugged in later."""
        if self._microphone is not None:
            if self._microphone.is_active:
                return
            self.get_logger().warning('The microphone was disconnected.')
            self._microphone.close()
            self._microphone = None
        try:
            self._microphone = Microphone(self._told.device, self._told.chunk_s, self._hand_over)
        except AudioError as error:
            self._complain(str(error))
        else:
            self._complaint = ''
            self.get_logger().info('Recording from the microphone.')

    def _hand_over(self, sound: bytes) -> None:
        """Publish a chunk in the thread of the executor."""
        executor = self.executor
        if executor is not None:
            executor.create_task(self._publish, sound)

    def _complain(self, sentence: str) -> None:
        """Log once why there is no audio; typed commands still work."""
        if sentence == self._complaint:
            return
        self._complaint = sentence
        if self._told.source == AUTO:
            self.get_logger().info(f'{sentence} You can type commands instead.')
        else:
            self.get_logger().warning(f'{sentence} Retrying every {_RETRY_S:g} s.')

    def _publish(self, sound: bytes) -> None:
        self._sound.publish(AudioData(data=array('B', sound)))


def main(args: list[str] | None = None) -> int:
    """
    Run the node `audio_source`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(AudioSource, args)


if __name__ == '__main__':
    sys.exit(main())
