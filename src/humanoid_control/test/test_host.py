# SPDX-License-Identifier: Apache-2.0
"""Check how robots are run inside a node."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.backends import Observation
from humanoid_control.controllers import follow_mode
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.host import Host
from humanoid_control.hosting.pacing import RealTimePace
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.mock_backend import MockBackend
from humanoid_control.testing import DRIVES, JOINTS, LIMITS
import pytest
from rclpy.node import Node
from std_msgs.msg import Empty

PERIOD_S = 0.01


class AtOnce:
    """A pace that waits for nothing."""

    def wait_s(self, now_s: float) -> float:
        """Return zero: every tick is due."""
        return 0.0

    def ticked(self, now_s: float) -> None:
        """Take no note."""

    def restart(self, now_s: float) -> None:
        """Go on."""


class World:
    """A host in a node, and the times of what it told."""

    def __init__(self, ros: RosSandbox, fast: bool) -> None:
        """Start."""
        self.times_s: list[float] = []
        self.looks = 0
        self.node = ros.observer()
        control = RobotControl(JOINTS, LIMITS, [follow_mode(JOINTS)])
        loop = ControlLoop(MockBackend(DRIVES, period_s=PERIOD_S), {'': control})
        pace = AtOnce() if fast else RealTimePace(PERIOD_S)
        interval_s = 0.0 if fast else PERIOD_S
        self.host = Host(self.node, loop, pace, interval_s, self._look, self._tell)

    def _look(self) -> None:
        self.looks += 1

    def _tell(self, observations: Mapping[str, Observation]) -> None:
        self.times_s.append(observations[''].time_s)


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def test_every_period_is_told(ros: RosSandbox) -> None:
    """Each tick looks for what has come, and tells what was observed, without a gap."""
    world = World(ros, fast=False)
    ros.wait_until(lambda: len(world.times_s) >= 20, what='ticks')
    assert world.looks == len(world.times_s)
    assert world.times_s == pytest.approx([n * PERIOD_S for n in range(len(world.times_s))])


def test_messages_are_heard_at_full_speed(ros: RosSandbox) -> None:
    """As fast as possible, the node still hears what comes."""
    world = World(ros, fast=True)
    heard: list[Empty] = []
    world.node.create_subscription(Empty, 'ping', heard.append, 10)
    publisher: Node = ros.observer()
    pings = publisher.create_publisher(Empty, 'ping', 10)

    def ping() -> bool:
        pings.publish(Empty())
        return len(heard) >= 5 and len(world.times_s) > 100

    ros.wait_until(ping, what='messages, and ticks')


def test_pause(ros: RosSandbox) -> None:
    """While it is paused, time passes by single ticks only; then it goes on."""
    world = World(ros, fast=False)
    ros.wait_until(lambda: len(world.times_s) >= 3, what='ticks')
    world.host.pause(True)
    before = len(world.times_s)
    for _ in range(5):
        world.host.tick()
    others = World(ros, fast=False)
    ros.wait_until(lambda: len(others.times_s) >= 10, what='ticks of another host')
    assert world.host.paused and len(world.times_s) == before + 5
    looks = world.looks
    ros.wait_until(lambda: world.looks > looks + 2, what='looks in the pause')
    world.host.pause(False)
    ros.wait_until(lambda: len(world.times_s) >= before + 10, what='ticks after the pause')


def test_ticks_in_a_pause(ros: RosSandbox) -> None:
    """They pass between callbacks; who asked for them is told, also if a pause ends them."""
    world = World(ros, fast=False)
    ros.wait_until(lambda: len(world.times_s) >= 3, what='ticks')
    world.host.pause(True)
    before, told = len(world.times_s), []
    world.host.tick_in_pause(30, lambda: told.append(len(world.times_s)))
    ros.wait_until(lambda: bool(told), what='the end of the ticks')
    assert told == [before + 30]
    world.host.tick_in_pause(10**9, lambda: told.append(-1))
    ros.wait_until(lambda: len(world.times_s) > before + 40, what='ticks')
    world.host.pause(True)
    assert told[1:] == [-1]


def test_change_of_pace(ros: RosSandbox) -> None:
    """The interval may change while it runs."""
    world = World(ros, fast=False)
    ros.wait_until(lambda: len(world.times_s) >= 3, what='ticks')
    world.host.change(PERIOD_S / 2.0)
    count = len(world.times_s)
    ros.wait_until(lambda: len(world.times_s) >= count + 10, what='more ticks')


def test_reset(ros: RosSandbox) -> None:
    """After a reset time goes on."""
    world = World(ros, fast=False)
    ros.wait_until(lambda: len(world.times_s) >= 3, what='ticks')
    last_s = world.times_s[-1]
    world.host.reset()
    world.host.tick()
    assert world.times_s[-1] > last_s
