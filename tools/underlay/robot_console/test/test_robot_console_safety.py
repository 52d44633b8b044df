# SPDX-License-Identifier: Apache-2.0
"""Connect to the small pages as a browser does, with a robot on the other side."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from http.client import HTTPConnection
import json
import os
from pathlib import Path
import threading
import time
from typing import Any
from unittest import mock

from domain_coordinator import domain_id
from geometry_msgs.msg import Twist
import pytest
import rclpy
from rclpy.context import Context as RosContext
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from robot_console.panels.drive import Drive
from robot_console.panels.safety import Safety
from robot_console.robot_link import LATCHED
from robot_console.small_page import page_text
from rviz_common.context import Context
from rviz_common.page import Page
from rviz_common.work_queue import WorkQueue
from std_msgs.msg import Bool, String
from websockets.exceptions import ConnectionClosed, ConnectionClosedError
from websockets.sync.client import ClientConnection, connect

MANY = QoSProfile(depth=100, reliability=ReliabilityPolicy.BEST_EFFORT)
PUSH = {'do': 'drive', 'press': 1, 'stick': [1, 0, 0], 'share': [1, 0.5]}


class World:
    """A page with both panels, and a robot, in a domain of their own."""

    def __init__(self, domain: int, page: Page, namespace: str) -> None:
        """Start the panels, and the robot's ears."""
        self.page, self.namespace = page, namespace
        self.ros = RosContext()
        rclpy.init(context=self.ros, domain_id=domain)
        self.node = Node('console', context=self.ros)
        self.robot = Node('robot', namespace=namespace, context=self.ros)
        self.heard: dict[str, list[Any]] = {'stop': [], 'beat': [], 'twist': []}
        self._hear(Bool, 'emergency_stop', LATCHED, 'stop')
        self._hear(Bool, 'console_heartbeat', MANY, 'beat')
        self._hear(Twist, 'cmd_vel', 100, 'twist')
        self.executor = SingleThreadedExecutor(context=self.ros)
        for node in (self.node, self.robot):
            self.executor.add_node(node)
        context = Context(self.node, page, None, WorkQueue())  # type: ignore[arg-type]
        given = {'Namespace': namespace}
        self.panels = [Safety(context, given), Drive(context, given)]
        for panel in self.panels:
            panel.start()

    def _hear(self, kind: type, topic: str, qos: Any, key: str) -> None:
        self.robot.create_subscription(kind, topic, self.heard[key].append, qos)

    def url(self, name: str) -> str:
        """Return the address of a small page."""
        below = f'/{self.namespace}' if self.namespace else ''
        return f'127.0.0.1:{self.page.port}/{name}{below}'

    def open(self, name: str, me: str = 'ann') -> Client:
        """Connect to a small page."""
        return Client(self, f'ws://{self.url(name)}?me={me}')

    def wait_until(self, predicate: Callable[[], bool], what: str) -> None:
        """Let time pass until something holds."""
        end_s = time.monotonic() + 20.0
        while not predicate():
            assert time.monotonic() < end_s, f'{what}; heard: {self.heard}'
            self.executor.spin_once(timeout_sec=0.02)
            for panel in self.panels:
                panel.update()

    def twists(self) -> list[tuple[float, float]]:
        """Return forward and turning speeds of what the robot heard."""
        return [(each.linear.x, each.angular.z) for each in self.heard['twist']]

    def stops(self) -> list[bool]:
        """Return what the robot heard of the emergency stop."""
        return [each.data for each in self.heard['stop']]

    def beats(self) -> list[bool]:
        """Return the heartbeats that the robot heard."""
        return [each.data for each in self.heard['beat']]

    def close(self) -> None:
        """End all of it."""
        for panel in self.panels:
            panel.close()
        self.page.close()
        self.executor.shutdown()
        for node in (self.node, self.robot):
            node.destroy_node()
        self.ros.try_shutdown()


class Client:
    """A small page that a browser shows."""

    def __init__(self, world: World, url: str) -> None:
        """Connect."""
        self.world = world
        self.connection: ClientConnection = connect(url)

    def say(self, message: Any) -> dict[str, Any]:
        """Send something, and return the answer."""
        self.connection.send(json.dumps(message))
        return json.loads(self.connection.recv(timeout=20))

    def close(self) -> None:
        """Disconnect in order."""
        self.connection.close()


@pytest.fixture(params=['', 'robot1'])
def world(request: pytest.FixtureRequest) -> Iterator[World]:
    """Return a page, panels and a robot, which find each other."""
    quiet = {'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    with domain_id() as domain, mock.patch.dict(os.environ, quiet):
        world = World(domain, Page('test'), request.param)
        try:
            names = ('emergency_stop', 'console_heartbeat', 'cmd_vel')
            world.wait_until(lambda: all(_is_heard(world, name) for name in names), 'no discovery')
            yield world
        finally:
            world.close()


def _is_heard(world: World, topic: str) -> bool:
    full = world.robot.resolve_topic_name(topic)
    return world.node.count_subscribers(full) > 0 and world.robot.count_publishers(full) > 0


def test_stop_at_once(world: World) -> None:
    """A stop is published by the connection, while the thread of the node does nothing."""
    page = world.open('safety')
    state = page.say({'do': 'stop'})
    assert state['stop']['pressed'] and state['stop']['by'] == state['you']
    world.wait_until(lambda: world.stops() == [True], 'no stop')
    assert page.say({'do': 'release'})['stop']['pressed'] is False
    world.wait_until(lambda: world.stops() == [True, False], 'no release')


def test_nothing_is_released_by_opening(world: World) -> None:
    """A page that is opened and closed says nothing about the stop and nothing about control."""
    page = world.open('safety')
    page.say({'do': 'beat'})
    page.close()
    world.open('drive').close()
    other = world.open('safety')
    other.say({'do': 'stop'})
    world.wait_until(lambda: bool(world.stops()), 'no stop')
    assert world.stops() == [True] and world.beats() == [] and world.twists() == []


def test_stop_of_others(world: World) -> None:
    """What others publish is shown, with who may have been it; it ends driving too."""
    page, drive = world.open('safety'), world.open('drive')
    drive.say(PUSH)
    publisher = world.robot.create_publisher(Bool, 'emergency_stop', 1)
    world.wait_until(lambda: publisher.get_subscription_count() > 0, 'no subscription')
    publisher.publish(Bool(data=True))
    world.wait_until(lambda: page.say({'do': 'beat'})['stop']['pressed'], 'not shown')
    name = world.robot.get_fully_qualified_name()
    world.wait_until(lambda: name in page.say({'do': 'beat'})['speakers'], 'no name')
    assert page.say({'do': 'beat'})['stop']['by'] == ''
    assert 'emergency stop' in drive.say(PUSH)['refusal']


def test_facts(world: World) -> None:
    """The page says who hears it, what the robot answers, and whether it is simulated."""
    page = world.open('safety')
    name = world.robot.get_fully_qualified_name()
    world.wait_until(lambda: page.say({'do': 'beat'})['listeners'] == [name], 'no listener')
    state = page.say({'do': 'beat'})
    assert (state['kind'], state['says']) == ('unknown', None)
    answer = world.robot.create_publisher(String, 'stop_state', LATCHED)
    answer.publish(String(data='a reason'))
    world.robot.create_publisher(Bool, '/clock', 1)
    world.wait_until(lambda: page.say({'do': 'beat'})['says'] == 'a reason', 'no answer')
    world.wait_until(lambda: page.say({'do': 'beat'})['kind'] == 'simulated', 'no clock')
    world.robot.destroy_publisher(answer)
    world.wait_until(lambda: page.say({'do': 'beat'})['says'] is None, 'the robot is gone')


def test_drive(world: World) -> None:
    """The robot gets velocities and heartbeats while a page is held, and a zero at the end."""
    page = world.open('drive')
    for _ in range(6):
        page.say(PUSH)
        time.sleep(0.05)
    page.say({'do': 'halt'})
    world.wait_until(lambda: world.twists()[-1:] == [(0.0, 0.0)], 'no zero')
    assert world.twists()[0] == (0.5, 0.0)
    world.wait_until(lambda: world.beats()[-1:] == [False], 'no farewell')
    assert True in world.beats()


@pytest.mark.parametrize('way', ['silent', 'closed', 'cut', 'wrong'])
def test_lost(world: World, way: str) -> None:
    """A page that falls silent or goes while it drives leaves a zero, and no farewell."""
    page = world.open('drive')
    page.say(PUSH)
    if way == 'closed':
        page.close()
    elif way == 'cut':
        page.connection.socket.shutdown(2)
    elif way == 'wrong':
        with pytest.raises(ConnectionClosedError, match='a page cannot do|1008'):
            page.say('nonsense')
    world.wait_until(lambda: world.twists() == [(0.5, 0.0), (0.0, 0.0)], 'no zero')
    other = world.open('safety', 'bob')
    assert other.say({'do': 'beat'})['control']['lost'].startswith('browser 1 (127.0.0.1)')
    assert False not in world.beats()


def test_one_driver(world: World) -> None:
    """A second browser is refused; two pages of one browser are one person."""
    first, second = world.open('drive', 'ann'), world.open('drive', 'bob')
    safety = world.open('safety', 'ann')
    assert first.say(PUSH)['velocity']
    assert 'browser 1 (127.0.0.1) is in control' in second.say(PUSH)['refusal']
    assert safety.say({'do': 'beat'})['control']['mine']


def test_end_of_the_page(world: World) -> None:
    """A page that ends while somebody drives leaves a zero."""
    page = world.open('drive')
    page.say(PUSH)
    for panel in world.panels:
        panel.close()
    world.panels = []
    world.wait_until(lambda: world.twists()[-1:] == [(0.0, 0.0)], 'no zero')


def test_other_file(world: World) -> None:
    """When the panels are closed and started anew, open pages come back to the new ones."""
    old, drive = world.open('safety'), world.open('drive')
    old.say({'do': 'stop'})
    for panel in world.panels:
        panel.close()
    for page in (old, drive):
        with pytest.raises(ConnectionClosed):
            page.connection.recv(timeout=20)
    for panel in world.panels:
        panel.start()
    new = world.open('safety')
    assert new.say({'do': 'beat'})['stop']['pressed'], 'the stop is not forgotten'
    new.say({'do': 'release'})
    world.wait_until(lambda: world.stops()[-1:] == [False], 'no release')


def test_many_clients(world: World) -> None:
    """Twenty browsers that press at once are all answered."""
    pages = [world.open('safety', str(number)) for number in range(20)]
    threads = [threading.Thread(target=page.say, args=[{'do': 'stop'}]) for page in pages]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(20)
    assert not any(thread.is_alive() for thread in threads)
    for page in pages:
        assert page.say({'do': 'beat'})['stop']['pressed']


@pytest.mark.parametrize('text', ['', '{', '[' * 100000, '{"do": "drive", "stick": [1e999]}'])
def test_wrong_text(world: World, text: str) -> None:
    """What no page would send ends the connection, and nothing else."""
    page = world.open('drive')
    page.connection.send(text)
    with pytest.raises(ConnectionClosedError):
        page.connection.recv(timeout=20)
    assert world.open('drive').say({'do': 'beat'})['velocity'] is None
    assert world.twists() == []


@pytest.mark.parametrize('name', ['safety', 'drive'])
def test_small_page(world: World, name: str) -> None:
    """The pages are complete, ask nobody else for anything, and know their topic."""
    host, _, path = world.url(name).partition('/')
    connection = HTTPConnection(host, timeout=30)
    connection.request('GET', f'/{path}')
    text = connection.getresponse().read().decode()
    assert 'class Link' in text and '--line:' in text and 'http://' not in text
    assert ('/robot1/' in text) == (world.namespace == 'robot1')


def test_settings_cannot_end_the_script() -> None:
    """A setting is data, whatever is in it."""
    assert '</script><b>' not in page_text('drive', {'topic': '</script><b>'})


def test_files_are_installed() -> None:
    """What the pages are made of is package data."""
    setup = (Path(__file__).parents[1] / 'setup.py').read_text(encoding='utf-8')
    assert "'web/*'" in setup
