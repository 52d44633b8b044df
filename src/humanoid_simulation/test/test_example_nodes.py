# SPDX-License-Identifier: Apache-2.0
"""Check the examples as nodes, with a stand-in for the simulator."""

from __future__ import annotations

from collections.abc import Iterator
import math
import signal
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Twist
from humanoid_common.testing.processes import module_command, running_program
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.walking.planar import PlanarPose
from humanoid_interfaces.srv import ApplyWrench, ResetSimulation
from nav_msgs.msg import Odometry
import pytest
from rclpy.node import Node

PERIOD_S = 0.02
STANDS_NS = 12.0


class FakeSimulator(Node):
    """A robot that goes as it is told, ten times faster than real, and falls when pushed hard."""

    def __init__(self, **options: Any) -> None:
        super().__init__('simulator', **options)
        self.velocity = Twist()
        self.pushes: list[ApplyWrench.Request] = []
        self.refuses = ''
        self._pose = PlanarPose(1 + 2j, 0.5)
        self._time_s = 0.0
        self._lies = False
        self._publishers = [
            self.create_publisher(Odometry, topic, 10) for topic in ('ground_truth/odom', 'odom')
        ]
        self.create_subscription(Twist, 'cmd_vel', self._obey, 1)
        self.create_service(ApplyWrench, '~/apply_wrench', self._be_pushed)
        self.create_service(ResetSimulation, '~/reset_simulation', self._stand_up)
        self.create_timer(PERIOD_S / 10, self._step)

    def _obey(self, message: Twist) -> None:
        self.velocity = message

    def _be_pushed(self, request: ApplyWrench.Request, response: Any) -> Any:
        self.pushes.append(request)
        force, duration_s = request.wrench.force, request.duration.nanosec * 1e-9
        self._lies = math.hypot(force.x, force.y) * duration_s > STANDS_NS
        response.success, response.message = not self.refuses, self.refuses
        return response

    def _stand_up(self, request: ResetSimulation.Request, response: Any) -> Any:
        self._lies = False
        response.success = True
        return response

    def _step(self) -> None:
        self._time_s += PERIOD_S
        go = self.velocity
        yaw_rad = self._pose.yaw_rad + go.angular.z * PERIOD_S
        place = self._pose.at(go.linear.x * PERIOD_S, go.linear.y * PERIOD_S)
        self._pose = PlanarPose(place, yaw_rad)
        message = Odometry()
        message.header.stamp = Time(sec=int(self._time_s), nanosec=int(self._time_s % 1 * 1e9))
        message.pose.pose.position.x, message.pose.pose.position.y = place.real, place.imag
        message.pose.pose.position.z = 0.1 if self._lies else 0.7
        message.pose.pose.orientation.w = math.cos(yaw_rad / 2)
        message.pose.pose.orientation.z = math.sin(yaw_rad / 2)
        for publisher in self._publishers:
            publisher.publish(message)


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
    assert 'Round. Closing error:' in report.output
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
        assert f'Stood, pushed {direction}: 10 N s' in report.output
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
    assert 'The simulator refused: There are several robots: say which.' in report.output


@pytest.mark.parametrize('name', ['walk_square', 'push_test'])
def test_without_a_simulator_it_says_so(ros: RosSandbox, name: str) -> None:
    """An example does not wait for ever, and ends with status 1."""
    with running_program(example(name)) as program:
        report = program.wait_for_exit(30.0)
    assert report.status == 1 and 'Traceback' not in report.output
    assert 'either no simulator runs there, or it is paused' in report.output


def test_pushes_that_make_no_sense_are_refused(ros: RosSandbox) -> None:
    """A parameter that contradicts another is named."""
    with running_program(example('push_test', 'first_ns:=50.0')) as program:
        report = program.wait_for_exit(30.0)
    assert report.status == 1
    assert "'first_ns' is 50, but must not be more than 'most_ns'" in report.output
