# SPDX-License-Identifier: Apache-2.0
"""Check the examples as nodes, with a stand-in for the simulator."""

from __future__ import annotations

from collections.abc import Iterator
import math
import signal

from geometry_msgs.msg import Twist
from humanoid_common.testing.processes import module_command, running_program
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_simulation.testing.fake_simulator import FakeSimulator
import pytest


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give a domain of one's own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def example(name: str, *parameters: str) -> list[str]:
    """Return the command of an example with parameters in the form name:=value."""
    settings = [text for each in parameters for text in ('-p', each)]
    return module_command(f'humanoid_simulation.examples.{name}', '--ros-args', *settings)


def test_the_square_is_walked(ros: RosSandbox) -> None:
    """The robot comes round, the node says so and ends in order, and the robot stands."""
    simulator = ros.start(FakeSimulator)
    with running_program(example('walk_square', 'side_m:=0.5', 'speed_m_s:=0.5')) as program:
        ros.wait_until(lambda: program.has_ended, 60.0, 'the end of the walk')
        report = program.wait_for_exit()
    assert report.status == 0, report.output
    assert 'Corner 4 of 4' in report.output
    assert 'Square completed. Closing error:' in report.output
    assert simulator.velocity == Twist()


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_the_robot(ros: RosSandbox, number: signal.Signals) -> None:
    """The last velocity that the robot hears is zero."""
    simulator = ros.start(FakeSimulator)
    with running_program(example('walk_square', 'side_m:=50.0')) as program:
        ros.wait_until(lambda: simulator.velocity.linear.x > 0, 30.0, 'the first step')
        program.send(number)
        ros.wait_until(lambda: program.has_ended, 15.0, 'the end')
        report = program.wait_for_exit()
    assert report.status == 0 and 'Traceback' not in report.output
    ros.wait_until(lambda: simulator.velocity == Twist(), 5.0, 'velocity zero')


def test_each_direction_is_pushed(ros: RosSandbox) -> None:
    """What the robot stands is found, by pushes in its own directions."""
    simulator = ros.start(FakeSimulator)
    with running_program(example('push_test')) as program:
        ros.wait_until(lambda: program.has_ended, 60.0, 'the end of the pushes')
        report = program.wait_for_exit()
    assert report.status == 0, report.output
    for direction in ('forward', 'back', 'left', 'right'):
        assert f'Strongest push withstood, {direction}: 10 N s' in report.output
    force = simulator.pushes[0].wrench.force
    assert (force.x, force.y) == pytest.approx((50 * math.cos(0.5), 50 * math.sin(0.5)))


def test_a_refused_push_ends_the_test(ros: RosSandbox) -> None:
    """The reason of the simulator is shown."""
    simulator = ros.start(FakeSimulator)
    simulator.refuses = 'There are several robots: say which.'
    with running_program(example('push_test')) as program:
        ros.wait_until(lambda: program.has_ended, 30.0, 'the refusal')
        report = program.wait_for_exit()
    assert report.status == 1 and 'Traceback' not in report.output
    assert (
        'The simulator rejected the request: There are several robots: say which.' in report.output
    )


@pytest.mark.parametrize('name', ['walk_square', 'push_test'])
def test_without_a_simulator_it_says_so(ros: RosSandbox, name: str) -> None:
    """An example does not wait for ever, and ends with status 1."""
    with running_program(example(name)) as program:
        report = program.wait_for_exit(30.0)
    assert report.status == 1 and 'Traceback' not in report.output
    assert 'either no simulator is running there, or it is paused' in report.output


def test_pushes_that_make_no_sense_are_refused(ros: RosSandbox) -> None:
    """A parameter that contradicts another is named."""
    with running_program(example('push_test', 'first_ns:=50.0')) as program:
        report = program.wait_for_exit(30.0)
    assert report.status == 1
    assert "'first_ns' is 50, but must not be more than 'most_ns'" in report.output
