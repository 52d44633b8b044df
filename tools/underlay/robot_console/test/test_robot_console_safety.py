# SPDX-License-Identifier: Apache-2.0
"""Connect to the small pages as a browser does, with a robot on the other side."""

from __future__ import annotations

from collections.abc import Iterator
from http.client import HTTPConnection
import json
from pathlib import Path
import threading
import time

from console_world import World, world_of
from geometry_msgs.msg import Twist
import pytest
import rclpy
from robot_console.page_text import page_text
from robot_console.robot_link import LATCHED
from std_msgs.msg import Bool, String
from websockets.exceptions import ConnectionClosed, ConnectionClosedError

PUSH = {'do': 'drive', 'press': 1, 'stick': [1, 0, 0], 'share': [1, 0.5]}


@pytest.fixture(params=['', 'robot1'])
def world(request: pytest.FixtureRequest) -> Iterator[World]:
    """Return a page, panels and a robot, which find each other."""
    with world_of(request.param) as world:
        yield world


def test_stop_at_once(world: World) -> None:
    """A stop is published by the connection, while the thread of the node does nothing."""
    page = world.visit('safety')
    state = page.say({'do': 'stop'})
    assert state['stop']['pressed'] and state['stop']['by'] == state['you']
    world.wait_until(lambda: world.stops() == [True], 'no stop')
    assert page.say({'do': 'release'})['stop']['pressed'] is False
    world.wait_until(lambda: world.stops() == [True, False], 'no release')


def test_nothing_is_released_by_opening(world: World) -> None:
    """A page that is opened and closed says nothing about the stop and nothing about control."""
    page = world.visit('safety')
    page.say({'do': 'beat'})
    page.close()
    world.visit('drive').close()
    other = world.visit('safety')
    other.say({'do': 'stop'})
    world.wait_until(lambda: bool(world.stops()), 'no stop')
    assert world.stops() == [True] and world.beats() == [] and world.twists() == []


def test_stop_of_others(world: World) -> None:
    """What others publish is shown, with who may have been it; it ends driving too."""
    page, drive = world.visit('safety'), world.visit('drive')
    drive.say(PUSH)
    publisher = world.robot.create_publisher(Bool, 'emergency_stop', 1)
    world.wait_until(lambda: publisher.get_subscription_count() > 0, 'no subscription')
    publisher.publish(Bool(data=True))
    world.wait_until(lambda: page.say({'do': 'beat'})['stop']['pressed'], 'not shown')
    name = world.robot.get_fully_qualified_name()
    world.wait_until(lambda: name in page.say({'do': 'beat'})['speakers'], 'no name')
    assert page.say({'do': 'beat'})['stop']['by'] == ''
    assert 'emergency stop' in drive.say(PUSH)['refusal']


@pytest.mark.parametrize('name', ['rosbag2_recorder', '_ros2cli_1'])
def test_who_only_listens_is_no_robot(world: World, name: str) -> None:
    """Nobody may believe that a recorder stops."""
    page = world.visit('safety')
    recorder = rclpy.create_node(name, context=world.ros)
    other = rclpy.create_node('other_robot', context=world.ros)
    for node in (recorder, other):
        node.create_subscription(Bool, world.stop_topic, print, 1)
    both = sorted([other.get_fully_qualified_name(), world.robot.get_fully_qualified_name()])
    world.wait_until(lambda: page.say({'do': 'beat'})['listeners'] == both, 'not both')
    for node in (recorder, other):
        node.destroy_node()


def test_who_hears_the_driver(world: World) -> None:
    """The page is told how many robots there are to drive."""
    drive = world.visit('drive')
    world.wait_until(lambda: drive.say({'do': 'beat'})['listeners'] == 1, 'not one')
    other = world.robot.create_subscription(Twist, 'cmd_vel', print, 1)
    world.wait_until(lambda: drive.say({'do': 'beat'})['listeners'] == 2, 'not two')
    world.robot.destroy_subscription(other)


def test_facts(world: World) -> None:
    """The page says who hears it, what the robot answers, and whether it is simulated."""
    page = world.visit('safety')
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
    page = world.visit('drive')
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
    page = world.visit('drive')
    page.say(PUSH)
    if way == 'closed':
        page.close()
    elif way == 'cut':
        page.connection.socket.shutdown(2)
    elif way == 'wrong':
        with pytest.raises(ConnectionClosedError, match='a page cannot request|1008'):
            page.say('nonsense')
    world.wait_until(lambda: world.twists() == [(0.5, 0.0), (0.0, 0.0)], 'no zero')
    other = world.visit('safety', 'bob')
    assert other.say({'do': 'beat'})['control']['lost'].startswith('browser 1 (127.0.0.1)')
    assert False not in world.beats()


def test_one_driver(world: World) -> None:
    """A second browser is refused; two pages of one browser are one person."""
    first, second = world.visit('drive', 'ann'), world.visit('drive', 'bob')
    safety = world.visit('safety', 'ann')
    assert first.say(PUSH)['velocity']
    assert 'browser 1 (127.0.0.1) is in control' in second.say(PUSH)['refusal']
    assert safety.say({'do': 'beat'})['control']['mine']


def test_end_of_the_page(world: World) -> None:
    """A page that ends while somebody drives leaves a zero."""
    page = world.visit('drive')
    page.say(PUSH)
    for panel in world.panels:
        panel.close()
    world.panels = []
    world.wait_until(lambda: world.twists()[-1:] == [(0.0, 0.0)], 'no zero')


def test_other_file(world: World) -> None:
    """When the panels are closed and started anew, open pages come back to the new ones."""
    old, drive = world.visit('safety'), world.visit('drive')
    old.say({'do': 'stop'})
    for panel in world.panels:
        panel.close()
    for page in (old, drive):
        with pytest.raises(ConnectionClosed):
            page.connection.recv(timeout=100)
    for panel in world.panels:
        panel.start()
    new = world.visit('safety')
    assert new.say({'do': 'beat'})['stop']['pressed'], 'the stop is not forgotten'
    new.say({'do': 'release'})
    world.wait_until(lambda: world.stops()[-1:] == [False], 'no release')


def test_many_clients(world: World) -> None:
    """Twenty browsers that press at once are all answered."""
    pages = [world.visit('safety', str(number)) for number in range(20)]
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
    page = world.visit('drive')
    page.connection.send(text)
    with pytest.raises(ConnectionClosedError):
        page.connection.recv(timeout=100)
    assert world.visit('drive').say({'do': 'beat'})['velocity'] is None
    assert world.twists() == []


@pytest.mark.parametrize('name', ['safety', 'drive'])
def test_small_page(world: World, name: str) -> None:
    """The pages are complete, ask nobody else for anything, and know their topic."""
    host, _, path = world.url(name).partition('/')
    connection = HTTPConnection(host, timeout=100)
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


def test_page_that_says_too_much(world: World) -> None:
    """However much a page says, the robot does not get it all at once, and others are heard."""
    drive, other = world.visit('drive'), world.visit('safety', 'bob')
    start_s = time.monotonic()
    for _ in range(300):
        drive.connection.send(json.dumps(PUSH))
    assert other.say({'do': 'stop'})['stop']['pressed']
    answers = [json.loads(drive.connection.recv(timeout=100)) for _ in range(300)]
    assert time.monotonic() - start_s > 1.0
    assert 'emergency stop' in answers[-1]['refusal']
