# SPDX-License-Identifier: Apache-2.0
"""The node and its programs: topics, services, the action, parameters."""

from __future__ import annotations

from collections.abc import Callable
import math
import signal
from typing import Any

from geometry_msgs.msg import Twist
from programs import Program
from publisher_probe import Probe
import pytest
from rclpy.action import ActionClient
from rclpy.action.client import GoalStatus
from rclpy.node import NodeNameNonExistentError
from std_srvs.srv import Empty
from turtlesim.action import RotateAbsolute
from turtlesim.msg import Color, Pose
from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative

CENTRE = 499.0 / 90.0
Start = Callable[..., Program]


class Zoo:
    """The node, from outside."""

    def __init__(self, probe: Probe, program: Program) -> None:
        """Listen to the first turtle."""
        self.probe = probe
        self.program = program
        self.poses: list[Pose] = probe.listen(Pose, '/turtle1/pose')
        self.colours: list[Color] = probe.listen(Color, '/turtle1/color_sensor')
        self.commands = probe.sender(Twist, '/turtle1/cmd_vel')
        self.clients: dict[str, Any] = {}
        self.rotation = ActionClient(probe.node, RotateAbsolute, '/turtle1/rotate_absolute')
        self.says('The turtles are at http://127.0.0.1')
        probe.until(lambda: self.poses and self.colours, 'no poses')

    def says(self, text: str) -> None:
        """Wait until the node logs a text."""
        self.probe.until(lambda: text in self.program.output, f'it does not say {text}')

    def call(self, kind: Any, service: str, /, **values: Any) -> Any:
        """Call a service, again after two seconds without a response; return the response."""
        if service not in self.clients:
            self.clients[service] = self.probe.node.create_client(kind, service)
        client = self.clients[service]
        self.probe.until(client.service_is_ready, f'there is no {service}')
        return self.probe.answer_to(
            lambda: client.call_async(kind.Request(**values)), f'{service} does not answer'
        )

    def comes_to(self, **fields: float) -> None:
        """Wait until the first turtle has a pose."""

        def is_there() -> bool:
            pose = self.poses[-1]
            return all(
                math.isclose(getattr(pose, name), value, abs_tol=1e-3)
                for name, value in fields.items()
            )

        self.probe.until(is_there, f'the turtle does not come to {fields}')

    def senses(self, *colour: int) -> None:
        """Wait until the first turtle is above a colour."""

        def is_there() -> bool:
            newest = self.colours[-1]
            return (newest.r, newest.g, newest.b) == colour

        self.probe.until(is_there, f'the turtle does not come to {colour}')

    def send_goal(self, theta: float, feedback: list[float] | None = None) -> Any:
        """Send a goal; return its handle."""
        self.probe.until(self.rotation.server_is_ready, 'no action')

        def take(message: Any) -> None:
            if feedback is not None:
                feedback.append(message.feedback.remaining)

        # A goal that is rejected may be repeated; then the server knows this client.
        refused = RotateAbsolute.Goal(theta=math.inf)
        self.probe.answer_to(lambda: self.rotation.send_goal_async(refused), 'no rejection')
        future = self.rotation.send_goal_async(RotateAbsolute.Goal(theta=theta), take)
        self.probe.until(future.done, 'no answer to the goal')
        return future.result()

    def result_of(self, future: Any) -> tuple[int, float]:
        """Wait for the result of a goal; return its status and how far the turtle has turned."""
        self.probe.until(future.done, 'no result')
        return future.result().status, future.result().result.delta


@pytest.fixture(scope='module')
def running(probe: Probe, start: Start) -> Zoo:
    """Start the node."""
    return Zoo(probe, start('turtlesim_node', '--ros-args', '-p', 'backgroud_r:=3'))


@pytest.fixture
def zoo(running: Zoo) -> Zoo:
    """Return the node, with one turtle in the middle."""
    running.call(Empty, '/reset')
    running.probe.until(running.commands.get_subscription_count, 'nobody hears commands')
    running.comes_to(x=CENTRE, y=CENTRE, theta=0.0, linear_velocity=0.0)
    return running


def test_names(zoo: Zoo) -> None:
    """The topics, services and action are those of tutorials, and so is what the node says."""
    node = zoo.probe.node
    for line in (
        'Starting turtlesim with node name /turtlesim',
        'Spawning turtle [turtle1] at x=[5.544445], y=[5.544445], theta=[0.000000]',
        "There is no parameter 'backgroud_r'. Did you mean 'background_r'?",
    ):
        assert line in zoo.program.output
    expected = {
        '/clear': 'std_srvs/srv/Empty',
        '/kill': 'turtlesim/srv/Kill',
        '/reset': 'std_srvs/srv/Empty',
        '/spawn': 'turtlesim/srv/Spawn',
        '/turtle1/set_pen': 'turtlesim/srv/SetPen',
        '/turtle1/teleport_absolute': 'turtlesim/srv/TeleportAbsolute',
        '/turtle1/teleport_relative': 'turtlesim/srv/TeleportRelative',
        '/turtle1/rotate_absolute/_action/send_goal': 'turtlesim/action/RotateAbsolute_SendGoal',
    }

    def own() -> dict[str, str]:
        try:
            services = node.get_service_names_and_types_by_node('turtlesim', '/')
        except NodeNameNonExistentError:  # not discovered yet
            return {}
        names = {name: kind for name, (kind,) in services}
        others = '/_action/cancel_goal', '/_action/get_result'
        return {
            name: kind
            for name, kind in names.items()
            if (name.count('/') == 1 or 'turtle1' in name) and not name.endswith(others)
        }

    zoo.probe.until(lambda: expected.keys() <= own().keys(), 'services are missing')
    assert own() == expected


def test_a_command_lasts_a_second(zoo: Zoo) -> None:
    """A turtle goes round for a second, says how fast, then stands; poses come all the time."""
    command = Twist()
    command.linear.x, command.angular.z = math.pi / 2, math.pi / 2
    zoo.poses.clear()
    zoo.commands.publish(command)
    zoo.probe.until(lambda: zoo.poses and zoo.poses[-1].angular_velocity, 'it stands')
    assert zoo.poses[-1].linear_velocity == pytest.approx(math.pi / 2)
    zoo.comes_to(x=CENTRE + 1.0, y=CENTRE + 1.0, theta=math.pi / 2, linear_velocity=0.0)


def test_walls(zoo: Zoo) -> None:
    """A turtle that runs against a wall stops there, and the node warns."""
    command = Twist()
    command.linear.x = -30.0
    zoo.commands.publish(command)
    zoo.comes_to(x=0.0, y=CENTRE)
    zoo.says('Oh no! I hit the wall! (Clamping from [x=-')
    zoo.says('y=5.544445])')


def test_pens_and_colours(zoo: Zoo) -> None:
    """A pen draws, also where a turtle is put; the sensor sees that, until it is erased."""
    zoo.senses(69, 86, 255)
    zoo.call(SetPen, '/turtle1/set_pen', r=255, g=10, b=20, width=5)
    zoo.call(TeleportAbsolute, '/turtle1/teleport_absolute', x=2.0, y=3.0, theta=math.pi / 2)
    zoo.comes_to(x=2.0, y=3.0, theta=math.pi / 2)
    zoo.call(TeleportRelative, '/turtle1/teleport_relative', linear=2.0, angular=0.0)
    zoo.comes_to(x=2.0, y=5.0)
    zoo.call(SetPen, '/turtle1/set_pen', off=1)
    zoo.call(TeleportAbsolute, '/turtle1/teleport_absolute', x=2.0, y=4.0)
    zoo.senses(255, 10, 20)
    zoo.call(Empty, '/clear')
    zoo.senses(69, 86, 255)
    zoo.says('Clearing turtlesim.')


def test_turtles_come_and_go(zoo: Zoo) -> None:
    """A new turtle has topics of its own, until it is killed; names are not given twice."""
    assert zoo.call(Spawn, '/spawn', name='turtle1').name == ''  # may be repeated, if lost
    assert zoo.call(Spawn, '/spawn', x=2.0, y=2.0, theta=0.2).name == 'turtle2'
    poses = zoo.probe.listen(Pose, '/turtle2/pose')
    zoo.probe.until(lambda: poses, 'no poses')
    assert (poses[-1].x, poses[-1].theta) == pytest.approx((2.0, 0.2))
    zoo.says('Spawning turtle [turtle2] at x=[2.000000], y=[2.000000], theta=[0.200000]')
    assert zoo.call(Spawn, '/spawn', x=2.0, y=2.0, name='turtle1').name == ''
    zoo.says('A turtle named [turtle1] already exists')
    assert zoo.call(Spawn, '/spawn', name='two words').name == ''
    zoo.says('[two words] cannot be the name of a turtle')
    assert zoo.call(Spawn, '/spawn', name='t' * 250).name == ''
    zoo.says('at most 100 characters')
    zoo.call(Kill, '/kill', name='turtle2')
    zoo.probe.until(lambda: not zoo.probe.node.count_publishers('/turtle2/pose'), 'it lives')
    zoo.call(Kill, '/kill', name='turtle2')
    zoo.says('Tried to kill turtle [turtle2], which does not exist')
    assert zoo.call(Spawn, '/spawn', name='turtle2').name == 'turtle2'
    zoo.call(Empty, '/reset')
    zoo.probe.until(lambda: not zoo.probe.node.count_publishers('/turtle2/pose'), 'it lives')


def test_rotation(zoo: Zoo) -> None:
    """A goal is reached with feedback on the way; the result is told, as in the log."""
    feedback: list[float] = []
    goal = zoo.send_goal(2.0, feedback)
    zoo.probe.until(lambda: any(0.0 < left < 2.0 for left in feedback), 'no feedback')
    result = zoo.probe.answer_to(goal.get_result_async, 'no result')
    assert result.status == GoalStatus.STATUS_SUCCEEDED
    assert result.result.delta == pytest.approx(-2.0)
    assert feedback == sorted(feedback, reverse=True)
    zoo.comes_to(theta=2.0, angular_velocity=0.0)
    zoo.says('Rotation goal completed successfully')


def test_rotation_is_canceled(zoo: Zoo) -> None:
    """A canceled goal stops the turtle on its way."""
    goal = zoo.send_goal(3.0)
    zoo.probe.until(lambda: zoo.poses[-1].theta > 0.1, 'it does not turn')
    zoo.probe.answer_to(goal.cancel_goal_async, 'no answer')
    result = zoo.probe.answer_to(goal.get_result_async, 'no result')
    assert result.status == GoalStatus.STATUS_CANCELED
    delta = result.result.delta
    zoo.comes_to(theta=-delta, angular_velocity=0.0)
    assert -delta < 3.0
    zoo.says('Rotation goal canceled')


@pytest.mark.parametrize('other', ['goal', 'reset', 'kill'])
def test_rotation_is_aborted(zoo: Zoo, other: str) -> None:
    """A goal ends where a newer one comes, or the turtle goes."""
    first = zoo.send_goal(3.0).get_result_async()
    zoo.probe.until(lambda: zoo.poses[-1].theta > 0.1, 'it does not turn')
    if other == 'goal':
        second = zoo.send_goal(0.0)
        zoo.says('Rotation goal received before a previous goal finished. Aborting previous goal')
        zoo.comes_to(theta=0.0, angular_velocity=0.0)
        status, delta = zoo.result_of(second.get_result_async())
        assert status == GoalStatus.STATUS_SUCCEEDED and delta > 0.1
    elif other == 'reset':
        zoo.call(Empty, '/reset')
    else:
        zoo.call(Kill, '/kill', name='turtle1')
    status, _ = zoo.result_of(first)
    assert status == GoalStatus.STATUS_ABORTED


def test_parameters(zoo: Zoo) -> None:
    """The background changes at once, and only to colours; holonomic turtles go sideways."""
    (done,) = zoo.probe.set_parameters('turtlesim', background_r=150)
    assert done.successful
    zoo.senses(150, 86, 255)
    (refused,) = zoo.probe.set_parameters('turtlesim', background_r=256)
    assert not refused.successful
    zoo.probe.set_parameters('turtlesim', background_r=69, holonomic=True)
    command = Twist()
    command.linear.y = 1.0
    zoo.commands.publish(command)
    zoo.comes_to(x=CENTRE, y=CENTRE + 1.0)
    zoo.probe.set_parameters('turtlesim', holonomic=False)


def test_numbers_that_are_none(zoo: Zoo) -> None:
    """What is not a number is refused with a sentence, and moves nothing."""
    command = Twist()
    command.linear.x = math.nan
    zoo.commands.publish(command)
    zoo.says('a command on /turtle1/cmd_vel. Not all of these numbers are finite: [nan, 0.0, 0.0]')
    zoo.call(TeleportAbsolute, '/turtle1/teleport_absolute', x=math.inf)
    zoo.says('Cannot teleport turtle [turtle1]. Not all of these numbers are finite: [inf,')
    assert not zoo.send_goal(math.inf).accepted
    zoo.comes_to(x=CENTRE, theta=0.0)


def test_square_and_mimic(zoo: Zoo, start: Start) -> None:
    """One turtle goes to a corner of its square, another one goes the same way."""
    poses = zoo.probe.listen(Pose, '/copy/turtle1/pose')
    names = '-r', '__ns:=/copy', '-r', '__node:=zoo2'
    copy = start('turtlesim_node', '--ros-args', *names)
    topics = '-r', 'input/pose:=turtle1/pose', '-r', 'output/cmd_vel:=copy/turtle1/cmd_vel'
    mimic = start('mimic', '--ros-args', *topics)
    zoo.probe.until(lambda: poses, 'no second node')
    assert 'Starting turtlesim with node name /copy/zoo2' in copy.output
    sent = zoo.probe.listen(Twist, '/copy/turtle1/cmd_vel')
    zoo.probe.until(lambda: sent, 'nothing is mimicked')
    square = start('draw_square')
    second = 'New goal [7.544445 7.544445, 1.570796]'
    zoo.probe.until(lambda: second in square.output, 'no corner')
    assert 'New goal [7.544445 5.544445, 0.000000]' in square.output
    assert 'Reached goal' in square.output
    zoo.probe.until(lambda: poses[-1].x > CENTRE + 1.0, 'the second turtle stays')
    for program, number in (
        (square, signal.SIGINT),
        (mimic, signal.SIGTERM),
        (copy, signal.SIGTERM),
    ):
        assert program.end(number) == 0
        assert 'Traceback' not in program.output


@pytest.mark.parametrize(
    ('words', 'sentence'),
    [
        (['left'], 'turtlesim_node takes no arguments, but was given: left.'),
        (['--ros-args', '-p', 'port:=70000'], 'The port is 70000, but must be from 1 to 65535.'),
    ],
)
def test_cannot_start(start: Start, words: list[str], sentence: str) -> None:
    """What is wrong at the start is a sentence and status 1."""
    program = start('turtlesim_node', *words)
    assert program.process.wait(100) == 1
    assert sentence in program.output
    assert 'Traceback' not in program.output


def test_end(running: Zoo) -> None:
    """Ctrl-C ends the node with status 0."""
    assert running.program.end(signal.SIGINT) == 0
    assert 'Traceback' not in running.program.output
