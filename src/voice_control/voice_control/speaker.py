# SPDX-License-Identifier: Apache-2.0
"""Text-to-speech output of the robot: the node `speaker`."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
import shutil
import subprocess
import sys
from typing import Any

from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.running import run_node
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_msgs.msg import Bool, String

__all__ = ['Speaker', 'SpeakerParameters', 'main']

_LOOK_S = 0.05
_MOST_WAITING = 5
_LONGEST_TEXT = 1000


@dataclass(frozen=True)
class SpeakerParameters:
    """The parameters of the node."""

    program: str = parameter(
        'espeak-ng',
        'The program that speaks the text on its standard input; it takes the options of '
        'espeak-ng.',
        read_only=True,
    )
    voice: str = parameter('en-us', 'The voice.', read_only=True)
    words_per_minute: int = parameter(
        165, 'The speaking rate (words per minute).', at_least=80, at_most=450, read_only=True
    )


class Speaker(Node):
    """
    Node that speaks the texts on `speech/say` in order; `speech/speaking` reports when.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('speaker', **options)
        told = NodeParameters(self, SpeakerParameters).current
        program = shutil.which(told.program)
        self._command = [program or '', '-v', told.voice, '-s', str(told.words_per_minute)]
        self._waiting: deque[str] = deque(maxlen=_MOST_WAITING)
        self._process: subprocess.Popen[bytes] | None = None
        self._speaking = self.create_publisher(Bool, 'speech/speaking', LATCHED)
        self._speaking.publish(Bool(data=False))
        if program is None:
            self.get_logger().info(
                f"Program '{told.program}' not found: the robot does not speak aloud, but its "
                'page shows what it says. To hear it: sudo apt install espeak-ng'
            )
            return
        self.create_subscription(String, 'speech/say', self._take, EVENT)
        self._timer = self.create_timer(
            _LOOK_S, self._look, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self._timer.cancel()

    def destroy_node(self) -> None:
        """Also stop speaking."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
        super().destroy_node()

    def _take(self, message: String) -> None:
        if text := message.data.strip()[:_LONGEST_TEXT]:
            self._waiting.append(text)
            self._timer.reset()
            self._look()

    def _look(self) -> None:
        """Start the next text once the previous one has been spoken."""
        if self._process is not None:
            if self._process.poll() is None:
                return
            self._end(self._process)
        if self._waiting:
            self._begin(self._waiting.popleft())
        else:
            self._timer.cancel()
            self._speaking.publish(Bool(data=False))

    def _begin(self, text: str) -> None:
        self._speaking.publish(Bool(data=True))
        self._process = subprocess.Popen(
            [*self._command, '--stdin'],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
        )
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(text.encode())
            self._process.stdin.close()
        except BrokenPipeError:
            pass  # the exit status reports it

    def _end(self, process: subprocess.Popen[bytes]) -> None:
        self._process = None
        assert process.stderr is not None
        complaint = process.stderr.read().decode(errors='replace').strip()
        process.stderr.close()
        if process.returncode:
            last = complaint.splitlines()[-1:] or [f'status {process.returncode}']
            self.get_logger().warning(
                f'The robot could not speak aloud: {last[0]}', throttle_duration_sec=60.0
            )


def main(args: list[str] | None = None) -> int:
    """
    Run the node `speaker`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    return run_node(Speaker, args)


if __name__ == '__main__':
    sys.exit(main())
