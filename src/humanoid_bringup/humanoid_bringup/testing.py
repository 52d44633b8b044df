# SPDX-License-Identifier: Apache-2.0
"""Command a simulated robot by text or speech, and observe what it says and does; for tests."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterator
import json
from pathlib import Path
from typing import Any

from audio_common_msgs.msg import AudioData
from humanoid_common.qos import EVENT, LATCHED
from humanoid_common.testing.ros import RosSandbox
from humanoid_common.testing.waiting import WaitedInVainError
from humanoid_interfaces.srv import MakePlan
from humanoid_perception.places_file import load_places, places_path
from humanoid_simulation.testing.clients import EntityClient
from humanoid_simulation.testing.simulators import RobotClient
from rclpy.clock import Clock, ClockType
from std_msgs.msg import Bool, String
from voice_control.audio import chunks, RATE_HZ, read_wav

__all__ = ['ToldRobot']

READY_S, PATIENCE_S = 120.0, 300.0
_PIECE_S, _SILENCE_S = 0.03, 1.0
_OVER = ('succeeded', 'failed', 'canceled')
_ANSWER_S = 5.0
_LISTENERS = 2
"""The subscribers of a command: the planner, and the executor, for a stop."""
_ANYTHING = 'turn left by 10 degrees'


class ToldRobot:
    """
    A robot in the simulated apartment, commanded by text or speech.

    Parameters
    ----------
    ros
        The nodes of the test. The full system has been launched in its domain.

    """

    def __init__(self, ros: RosSandbox) -> None:
        self.ros = ros
        self.said: list[str] = []
        """What the robot has said since `forget`."""
        self.plan: dict[str, Any] | None = None
        """The newest plan since `forget`, with its steps and their states."""
        self._node = ros.observer()
        self._node.create_subscription(String, 'speech/say', self._hear, EVENT)
        self._node.create_subscription(String, 'executor/state', self._take_state, LATCHED)
        self._node.create_subscription(Bool, 'speech/speaking', self._take_speaking, LATCHED)
        self._commands = self._node.create_publisher(String, 'user_command', EVENT)
        self._sound = self._node.create_publisher(AudioData, 'audio', EVENT)
        self._planner = self._node.create_client(MakePlan, 'task_planner/plan')
        self._pieces: Iterator[bytes] = iter(())
        self._is_speaking = False
        self._player = self._node.create_timer(
            _PIECE_S, self._play, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self._player.cancel()
        self.robot, self.entities = RobotClient(ros), EntityClient(ros)
        path = places_path('apartment')
        assert path is not None
        self.places = load_places(path)
        self.wait_for('I am ready', READY_S)
        self.wait_until_it_plans()

    @property
    def room(self) -> str:
        """Return the name of the room that the robot is truly in."""
        at = self.robot.pose.position_m
        return self.places.room_at(at.real, at.imag)

    @property
    def is_over(self) -> bool:
        """Whether the newest plan has ended."""
        states = [each['state'] for each in self.plan['steps']] if self.plan else ['waiting']
        return states[-1] == 'succeeded' or any(each in _OVER[1:] for each in states)

    @property
    def has_succeeded(self) -> bool:
        """Whether all steps of the newest plan have succeeded, as the robot reports."""
        return (
            self.is_over
            and self.plan is not None
            and (all(each['state'] == 'succeeded' for each in self.plan['steps']))
        )

    def forget(self) -> None:
        """Clear what was said, and the plan."""
        self.said.clear()
        self.plan = None

    def tell(self, text: str) -> None:
        """
        Type a command: publish it on `user_command`.

        Parameters
        ----------
        text
            The command.

        """
        self._commands.publish(String(data=text))

    def speak(self, path: Path) -> None:
        """
        Play a WAV file to the recogniser in real time, once the robot is silent.

        Parameters
        ----------
        path
            The file.

        """
        self.wait_until(lambda: not self._is_speaking, 60.0, 'silence')
        silence = b'\0' * int(_SILENCE_S * RATE_HZ) * 2
        self._pieces = chunks(silence + read_wav(path) + silence, _PIECE_S)
        self._player.reset()

    def wait_until(self, condition: Callable[[], bool], timeout_s: float, what: str) -> None:
        """
        Wait, in real time, until a condition holds; the robot has to stay on its feet.

        Parameters
        ----------
        condition
            Called between callbacks.
        timeout_s
            How long to wait.
        what
            Description of the condition, for the error message.

        Raises
        ------
        WaitedInVainError
            The condition does not hold in time.
        AssertionError
            The robot fell.

        """

        def holds() -> bool:
            assert self.robot.stands, f'The robot fell. It has said {self.said}'
            return condition()

        self.ros.wait_until(
            holds,
            timeout_s,
            lambda: f'{what}; the robot has said {self.said}, and its plan is {self.plan}',
        )

    def wait_for(self, text: str, timeout_s: float = PATIENCE_S) -> None:
        """
        Wait until the robot has said something since `forget`.

        Parameters
        ----------
        text
            A part of it.
        timeout_s
            As for `wait_until`, which also documents the exceptions.

        """
        self.wait_until(lambda: any(text in each for each in self.said), timeout_s, repr(text))

    def wait_for_the_end(self, timeout_s: float = PATIENCE_S) -> None:
        """
        Wait until a plan has ended without a successor, and the robot has said something about it.

        Parameters
        ----------
        timeout_s
            How long each plan may take, in real time; see `wait_until` for what is raised.

        """
        while True:
            self.wait_until(lambda: self.is_over, timeout_s, 'the end of a plan')
            self.wait_until(lambda: bool(self.said), 5.0, 'a word about it')
            self.robot.wait(1.0)
            if self.is_over:
                return

    def wait_until_it_plans(self) -> None:
        """Wait until the planner answers a request with a plan."""

        def plans() -> bool:
            heard_by = self._commands.get_subscription_count()
            if not (self._planner.service_is_ready() and heard_by >= _LISTENERS):
                return False
            answer = self._planner.call_async(MakePlan.Request(command=_ANYTHING))
            try:
                self.ros.wait_until(answer.done, _ANSWER_S, 'a plan')
            except WaitedInVainError:  # a killed planner stays in the graph for some seconds
                return False
            return bool(answer.result().success)

        self.ros.wait_until(plans, READY_S, 'a robot that accepts commands')

    def _hear(self, message: String) -> None:
        self.said.append(message.data)

    def _take_state(self, message: String) -> None:
        told = json.loads(message.data)
        self.plan = told if told['steps'] else None  # an executor that has just started has none

    def _take_speaking(self, message: Bool) -> None:
        self._is_speaking = message.data

    def _play(self) -> None:
        piece = next(self._pieces, None)
        if piece is None:
            self._player.cancel()
        else:
            self._sound.publish(AudioData(data=array('B', piece)))
