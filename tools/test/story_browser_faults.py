# SPDX-License-Identifier: Apache-2.0
"""What goes wrong with browsers, or people and robots send, harms no page: `make stories`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from http.client import HTTPConnection, HTTPResponse
from itertools import islice, takewhile
import json
import os
from random import Random
import signal
import socket
from threading import Thread
import time
from typing import Any
from urllib.parse import urlsplit

from browser import browser_started
from browser_world import memory_mb, pid_of, url_of, World, world
from leftovers import runs
from programs import Program, wait_until
import pytest
from random_messages import page_messages, ros_message, viser_messages
from ros_side import LATCHED
from rviz_common.plugins import DISPLAYS, load_plugin, plugin_names
from rviz_common.properties import topic_path
from sensor_msgs.msg import Image
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from viser_client import camera_message, connected, packed, stream
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect
import yaml

FOREARM = 'left_forearm'
SLACK_MB = 30.0
STRICT = ('env', 'PYTHONWARNINGS=error::RuntimeWarning')
SMALL_PAGES = {
    'safety': ('beat', 'take', 'give', 'release', 'fly'),
    'drive': ('beat', 'drive', 'drive', 'halt'),
    'topics': ('choose', 'rates'),
    'parameters': ('choose', 'set'),
    'services': ('choose', 'call'),
    'log': ('all',),
    'diagnostics': ('choose', 'forget'),
}


@pytest.fixture(scope='module')
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[World]:
    """Start the humanoid, which nobody shows."""
    with world(tmp_path_factory.mktemp('faults')) as made:
        made.launch('humanoid_bringup', 'bringup.launch.py', 'backend:=mock', 'gui:=false')
        yield made


@pytest.fixture(scope='module')
def console(robot: World) -> Program:
    """Start the console of the humanoid."""
    return show(robot)


def show(robot: World, **arguments: Any) -> Program:
    """Start a console, and wait until it serves all of its pages."""
    given = [f'{name}:={value}' for name, value in arguments.items()]
    program = robot.launch('humanoid_bringup', 'console.launch.py', *given)
    url = url_of(program)
    wait_until(
        lambda: all(ask_with_token(url, f'/{name}').status == 200 for name in SMALL_PAGES),
        100.0,
        'all pages',
    )
    return program


def visit(program: Program, **options: Any) -> ClientConnection:
    """Connect to a page, and say how one looks at the scene, as a browser does."""
    connection = connected(url_of(program), **options)
    connection.send(packed(camera_message()))
    return connection


def turns(connection: ClientConnection, count: int) -> int:
    """Wait until the forearm has turned so many times in the scene; return how often it did."""
    names = (
        message['name']
        for message in stream(connection, 60.0)
        if message['type'] == 'SetOrientationMessage'
    )
    return sum(1 for _ in islice((each for each in names if each.endswith(FOREARM)), count))


def is_well(program: Program) -> bool:
    """Tell whether a new visitor sees the robot move."""
    with visit(program) as connection:
        return turns(connection, 10) == 10


def ask(url: str, path: str = '/', **headers: str) -> HTTPResponse:
    """Return the answer to a request."""
    connection = HTTPConnection(urlsplit(url).netloc, timeout=100)
    connection.request('GET', path, headers=headers)
    return connection.getresponse()


def ask_with_token(url: str, path: str = '/') -> HTTPResponse:
    """Return the answer to a request of a browser that has opened the address."""
    welcome = ask(url, f'/?{urlsplit(url).query}')
    return ask(url, path, Cookie=(welcome.getheader('Set-Cookie') or '').partition(';')[0])


def test_a_browser_is_killed(robot: World, console: Program) -> None:
    """The page goes on without it, in as much memory; a new browser sees the robot."""
    pid, url = pid_of(console, 'rviz2'), url_of(console)
    with browser_started() as browser:
        browser.open(url).wait_for_link(FOREARM)
        before_mb = memory_mb(pid)
        browser_pid = browser.pid()
        os.kill(browser_pid, signal.SIGKILL)
        wait_until(lambda: not runs(browser_pid), 20.0, 'the end of the browser')
    with visit(console) as connection:
        assert turns(connection, 100) == 100
    assert memory_mb(pid) < before_mb + SLACK_MB
    with browser_started() as browser:
        browser.open(url).wait_for_link(FOREARM)
    assert robot.complaints() == []


@pytest.mark.parametrize('number', [signal.SIGKILL, signal.SIGINT])
def test_a_page_comes_back_by_itself(robot: World, number: int) -> None:
    """A page whose server has ended says so; it shows the robot again when there is one."""
    first = show(robot, token='kept', port=own_port())
    url = url_of(first)
    with browser_started() as browser:
        tab = browser.open(url)
        tab.wait_for_link(FOREARM)
        first.end(number)
        wait_until(lambda: not first.members(), 100.0, 'the end of all that was launched')
        words = tab.small('safety').locator('#link')
        words.filter(has_text='this page cannot stop the robot').wait_for()
        second = show(robot, port=urlsplit(url).port, token='kept')
        words.filter(has_text='connected').wait_for()
        tab.wait_for_motion(FOREARM)
        assert tab.failures == []
    second.clean_up()


def own_port() -> int:
    """
    Return a free port that nobody takes by itself while a page is away.

    Programs of tests beside this one take the first free port from 8080 on, and connections those
    from 32768 on.
    """
    for port in Random().sample(range(20_000, 30_000), 100):
        with suppress(OSError), socket.create_server(('127.0.0.1', port)):
            return port
    raise OSError('No port is free.')


def test_twenty_browsers(robot: World, console: Program) -> None:
    """All see the robot move, in a bounded memory."""
    pid = pid_of(console, 'rviz2')
    before_mb = memory_mb(pid)
    seen: list[int] = []

    def look() -> None:
        with visit(console) as connection:
            seen.append(turns(connection, 30))

    threads = [Thread(target=look, daemon=True) for _ in range(20)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(90.0)
    assert seen == [30] * 20
    assert memory_mb(pid) < before_mb + 2 * SLACK_MB
    assert robot.complaints() == []


@pytest.mark.parametrize('token', ['sesame', ''])
def test_who_may_see_the_page(robot: World, token: str) -> None:
    """Other sites are refused, and so is who does not know the token."""
    program = show(robot, **({'token': token} if token else {}))
    url = url_of(program)
    token = url.partition('?token=')[2]
    assert url.endswith(f'/?token={token}')
    evil = {'Origin': 'http://evil.example'}
    upgrade = {
        'Connection': 'Upgrade',
        'Upgrade': 'websocket',
        'Sec-WebSocket-Version': '13',
        'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==',
    }
    for path in ('/', '/safety', '/drive'):
        for headers in ({}, upgrade):
            assert ask(url, path, **headers).status == 401
            assert ask(url, f'{path}?token=open', **headers).status == 403
            assert ask(url, f'{path}?token={token}', **evil, **headers).status == 403
    welcome = ask(url, f'/?token={token}')
    assert (welcome.status, welcome.getheader('Location')) == (303, '/')
    cookie = welcome.getheader('Set-Cookie').partition(';')[0]
    assert ask(url, '/', Cookie=cookie).status == 200
    program.clean_up()


def test_what_no_page_sends(robot: World) -> None:
    """A thousand broken messages harm neither the page nor those inside of it."""
    program, chance = show(robot), Random(6)
    pid, url = pid_of(program, 'rviz2'), url_of(program)
    with visit(program) as connection:
        widgets = [each for each in replay(connection) if 'Button' not in each['type']]
        before_mb = memory_mb(pid)
        ids = [each['uuid'] for each in widgets if each['type'].startswith('Gui')]
        for message in islice(viser_messages(chance, ids), 500):
            connection.send(message)
    for name, actions in SMALL_PAGES.items():
        send_until_refused(socket_of(url, name), islice(page_messages(chance, actions), 75))
    with visit(program) as connection:
        assert len(replay(connection)) > 100
    with connect(socket_of(url, 'safety')) as connection:
        connection.send('{"do": "beat"}')
        assert 'control' in json.loads(connection.recv(timeout=60))
    assert ask_with_token(url).status == 200
    assert memory_mb(pid) < before_mb + SLACK_MB
    program.clean_up()
    assert robot.complaints() == []


def socket_of(url: str, name: str) -> str:
    """Return where a small page connects to, with the token."""
    return url.replace('http:', 'ws:').replace('/?', f'/{name}?')


def replay(connection: ClientConnection) -> list[dict[str, Any]]:
    """Return the messages that whoever comes gets first."""
    coming = stream(connection, 60.0)
    return list(takewhile(lambda each: each['type'] != 'ReplayDoneMessage', coming))


def send_until_refused(url: str, texts: Iterator[bytes | str]) -> None:
    """Send messages to a small page, and come again each time it ends the connection."""
    connection = connect(url)
    for text in texts:
        try:
            connection.send(text)
            connection.recv(timeout=0.02)
        except TimeoutError:
            pass
        except ConnectionClosed as error:
            assert error.rcvd is not None and error.rcvd.code == 1008, f'{error} for {text!r}'
            connection = connect(url)
    connection.close()


@pytest.fixture(scope='module')
def gallery(robot: World, tmp_path_factory: pytest.TempPathFactory) -> Program:
    """Start an RViz with each display that there is, on a topic of its own."""
    entries = [
        {'Class': name, 'Name': name, 'Enabled': True, **_topic(name)}
        for name in plugin_names(DISPLAYS)
    ]
    options = {'Fixed Frame': 'base_link', 'Frame Rate': 60}
    manager = {'Displays': entries, 'Global Options': options, 'Enabled': True}
    file = tmp_path_factory.mktemp('gallery') / 'all.rviz'
    file.write_text(yaml.safe_dump({'Visualization Manager': manager}))
    program = robot.start(*STRICT, 'ros2', 'run', 'rviz2', 'rviz2', '-d', str(file))
    url_of(program)
    return program


def _topic(name: str) -> dict[str, Any]:
    path = topic_path(load_plugin(DISPLAYS, name).PROPERTIES)
    return {path.partition('/')[0]: {'Value': topic_of(name)}} if path else {}


def topic_of(name: str) -> str:
    """Return the topic of a display."""
    return f'/gallery/{name.partition("/")[2]}'


def test_what_no_robot_says(robot: World, gallery: Program) -> None:
    """A thousand broken messages leave all displays at work, in a bounded memory."""
    pid, chance = rviz_of(gallery), Random(6)
    node = robot.ros.node
    publishers = [(kind, node.create_publisher(kind, topic, LATCHED)) for topic, kind in spoken()]
    for _, publisher in publishers:
        wait_until(publisher.get_subscription_count, 60.0, f'who hears {publisher.topic}')

    def speak(count: int) -> None:
        for number in range(count):
            kind, publisher = publishers[number % len(publishers)]
            publisher.publish(ros_message(kind, chance))
            time.sleep(0.003)  # of those that come in one frame only the last is shown

    with visit(gallery) as connection:
        speak(500)
        before_mb = memory_mb(pid)
        speak(500)
        connection.recv(timeout=60)
    assert memory_mb(pid) < before_mb + SLACK_MB
    assert robot.complaints() == []
    for _, publisher in publishers:
        node.destroy_publisher(publisher)


def test_a_browser_does_not_read(robot: World, gallery: Program) -> None:
    """A browser that stalls costs no memory, and the others see what is new."""
    pid, topic = rviz_of(gallery), topic_of('rviz_default_plugins/Image')
    publisher = robot.ros.node.create_publisher(Image, topic, 1)
    wait_until(publisher.get_subscription_count, 60.0, f'who hears {topic}')
    picture = Image(height=960, width=1280, encoding='mono8', step=1280)
    picture.header.frame_id = 'base_link'
    noise = Random(6).randbytes(2 * 960 * 1280)
    with visit(gallery, max_queue=1) as stalled, visit(gallery) as reading:

        def show_pictures(size_mb: float) -> None:
            received, end_s = 0, time.monotonic() + 100.0
            while received < size_mb * 1e6:
                assert time.monotonic() < end_s, f'{received} bytes have come'
                start = received % (960 * 1280)
                picture.data = noise[start : start + 960 * 1280]
                publisher.publish(picture)
                with suppress(TimeoutError):  # what comes is not always the picture
                    received += len(reading.recv(timeout=0.2))

        show_pictures(20.0)
        before_mb = memory_mb(pid)
        show_pictures(1.5 * SLACK_MB)
        assert memory_mb(pid) < before_mb + SLACK_MB
        assert stalled.recv(timeout=60)
    robot.ros.node.destroy_publisher(publisher)
    assert robot.complaints() == []


def rviz_of(program: Program) -> int:
    """Return the id of the process of RViz."""
    return next(pid for pid in program.members() if 'rviz2' in name_of(pid))


def name_of(pid: int) -> str:
    """Return the first words of the command of a process."""
    with open(f'/proc/{pid}/cmdline') as file:
        return ' '.join(file.read().split('\0')[:2])


def spoken() -> list[tuple[str, type]]:
    """Return the topics of all displays."""
    displays = {name: load_plugin(DISPLAYS, name) for name in plugin_names(DISPLAYS)}
    found = {
        topic_of(name): kind.MESSAGE for name, kind in displays.items() if hasattr(kind, 'MESSAGE')
    }
    return [*found.items(), ('/tf', TFMessage), (topic_of('/RobotModel'), String)]
