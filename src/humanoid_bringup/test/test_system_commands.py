# SPDX-License-Identifier: Apache-2.0
"""Check that the whole robot does what it is told, in its home, and tells the truth."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from humanoid_common.qos import EVENT
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_interfaces.srv import MakePlan
from humanoid_simulation.scene import load_scene
from humanoid_simulation.testing.simulated_robot import SimulatedRobot
import pytest
from std_msgs.msg import String

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'full_system.launch.py'
STORY = 'go to the kitchen, find the red mug and tell me what stands beside it'
READY_S, PATIENCE_S = 120.0, 240.0

pytestmark = pytest.mark.timeout(600)


class Listener:
    """Somebody who tells the robot what to do, and hears what it says."""

    def __init__(self, ros: RosSandbox) -> None:
        self.ros, self.robot = ros, SimulatedRobot(ros)
        self.said: list[str] = []
        self._node = ros.observer()
        self._commands = self._node.create_publisher(String, 'user_command', EVENT)
        self._node.create_subscription(
            String, 'speech/say', lambda message: self.said.append(message.data), EVENT
        )
        self._planner = self._node.create_client(MakePlan, 'task_planner/plan')
        ros.wait_until(self._is_ready, READY_S, 'a robot that can be told something')

    def _is_ready(self) -> bool:
        if not self._planner.service_is_ready() or not self._commands.get_subscription_count():
            return False
        answer = self._planner.call_async(MakePlan.Request(command=STORY))
        self.ros.wait_until(answer.done, READY_S, 'a plan')
        return bool(answer.result().success)

    def tell(self, text: str) -> None:
        """Tell the robot to do something."""
        self._commands.publish(String(data=text))

    def wait_for(self, text: str) -> None:
        """Wait until the robot says something."""
        self.ros.wait_until(
            lambda: any(text in each for each in self.said), PATIENCE_S, f'{text!r}: {self.said}'
        )


@pytest.fixture(scope='module')
def listener() -> Iterator[Listener]:
    arguments = ('gui:=false', 'real_time_factor:=0.7')
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, *arguments):
        yield Listener(ros)


def test_it_goes_looks_and_tells(listener: Listener):
    listener.tell(STORY)
    listener.wait_for('I see the red mug on the kitchen table.')
    listener.wait_for('beside the red mug.')
    place = listener.robot.pose.position_m
    assert -0.7 < place.real < 2.7 and 0.7 < place.imag < 4.2, 'This is not the kitchen.'
    said = next(each for each in listener.said if 'beside the red mug.' in each)
    things = {each.name: each for each in load_scene('apartment').objects}
    mug, neighbour = things['red_mug'], things['blue_mug']
    assert abs(complex(*mug.position_m[:2]) - complex(*neighbour.position_m[:2])) < 0.5
    assert 'blue mug' in said


def test_it_stops_at_once(listener: Listener):
    robot = listener.robot
    begin = robot.pose.position_m
    listener.tell('go to the hall')
    assert robot.wait_until(lambda: abs(robot.pose.position_m - begin) > 0.3, 60.0)
    listener.tell('stop')
    listener.wait_for('I have stopped.')
    robot.wait(2.0)
    place = robot.pose.position_m
    robot.wait(2.0)
    assert abs(robot.pose.position_m - place) < 0.05
    assert listener.robot.stands


def test_it_says_what_it_cannot_do(listener: Listener):
    listener.tell('bring me the red mug')
    listener.wait_for('I have no hands yet.')
    listener.tell('fly to the moon')
    listener.wait_for('I did not understand "fly to the moon".')
