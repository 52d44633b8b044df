# SPDX-License-Identifier: Apache-2.0
"""The panel of recordings, with its processes, over DDS; a test presses its buttons."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
import os
from pathlib import Path
import re
import signal
import subprocess
import sys
import threading
import time
from types import SimpleNamespace
from typing import Any
from unittest import mock

from domain_coordinator import domain_id
import pytest
import rclpy
from rclpy.context import Context as RosContext
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from recorded_samples import write_bag
from robot_console.panels.recordings import Recordings
from robot_console.recordings.bags import Bag, Shelf
from robot_console.recordings.child import Child
from robot_console.recordings.scene_folder import SceneTape, TooLarge
from rviz_common.context import Context
from rviz_common.inputs import WorkQueue
from rviz_common.page import NO_TOKEN, Page, PageSettings
from rviz_common.status import Statuses
from std_msgs.msg import String

PARENT = """
import sys, time
from robot_console.recordings.child import Child
child = Child('record', ['-o', sys.argv[1], '--disable-keyboard-controls', '--all'])
print(child.pid, flush=True)
time.sleep(600)
"""


class Buffer:
    """Counts how often frames are forgotten."""

    def __init__(self) -> None:
        """Begin with none."""
        self.clears = 0

    def clear(self) -> None:
        """Forget them."""
        self.clears += 1


class World:
    """A page with the panel, and a talker, in a domain of their own."""

    def __init__(self, domain: int, page: Page, folder: Path) -> None:
        """Start them."""
        self.page, self.folder = page, folder
        self.ros = RosContext()
        rclpy.init(context=self.ros, domain_id=domain)
        self.node = Node('console', context=self.ros)
        self.talker = Node('talker', context=self.ros)
        self.executor = SingleThreadedExecutor(context=self.ros)
        for node in (self.node, self.talker):
            self.executor.add_node(node)
        self.buffer, self.status = Buffer(), Statuses()
        self.context = Context(
            self.node,
            page,
            SimpleNamespace(buffer=self.buffer),  # type: ignore[arg-type]
            WorkQueue(),
            SimpleNamespace(status=self.status),
        )
        self.panel = Recordings(self.context, {'Folder': str(folder), 'Seconds': 5})
        self.panel.start()
        self.play, self.record = self.panel._play, self.panel._record
        self.heard: list[str] = []

    def talk(self) -> None:
        """Publish numbers from now on."""
        publisher = self.talker.create_publisher(String, 'ticks', 100)
        self.talker.create_timer(0.02, lambda: publisher.publish(String(data='live')))

    def listen(self, topic: str) -> None:
        """Hear what is published."""
        self.talker.create_subscription(
            String, topic, lambda message: self.heard.append(message.data), 100
        )

    def run(self, until: Callable[[], Any], what: str) -> None:
        """Let time pass until something holds."""
        end_s = time.monotonic() + 60.0
        while not until():
            assert time.monotonic() < end_s, f'{what}; {self.texts()}'
            self.executor.spin_once(timeout_sec=0.02)
            self.context.queue.run()
            self.panel.update()

    def texts(self) -> str:
        """Return what the panel says."""
        parts = (self.record, self.panel._memory, self.play, self.panel._scene)
        return ' | '.join(part._text.content for part in parts)

    def close(self) -> None:
        """End all of it."""
        self.panel.close()
        self.page.close()
        self.executor.shutdown()
        for node in (self.node, self.talker):
            node.destroy_node()
        self.ros.try_shutdown()


@pytest.fixture
def world(tmp_path: Path) -> Iterator[World]:
    """Return a page with the panel; children get the same domain."""
    with domain_id() as domain:
        environment = {
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }
        with mock.patch.dict(os.environ, environment):
            world = World(domain, Page('test', PageSettings(token=NO_TOKEN)), tmp_path / 'bags')
            yield world
            world.close()


def recorded(world: World) -> dict[str, int]:
    """Return how many messages of which topics the newest recording has."""
    bag = Shelf(str(world.folder)).look()[0]
    assert not bag.problem
    return {each.name: each.message_count for each in bag.topics}


def test_record(world: World) -> None:
    """What is published between two presses of the button is recorded, and then listed."""
    world.talk()
    world.record._name.value = 'walk'
    world.record._press()
    world.record.update()
    assert 'Starting to record **walk**' in world.record._text.content
    path = world.folder / 'walk' / 'walk_0.mcap'
    world.run(lambda: path.exists() and path.stat().st_size > 10_000, 'nothing is recorded')
    world.run(lambda: '● Recording **walk**' in world.record._text.content, 'it does not say so')
    world.record._press()
    world.run(lambda: world.record.path == '', 'the recording does not end')
    assert '✔ Recorded **walk**' in world.record._text.content
    assert recorded(world)['/ticks'] > 10
    world.run(lambda: world.play.chooser.bag, 'the recording is not listed')
    write_bag(world.folder / 'newer', '/x')
    world.run(lambda: len(world.play.chooser._bags) == 2, 'the other one is not listed')
    assert world.play.chooser.bag.name == 'walk'
    world.record._name.value = 'run'
    world.record._press()
    second = world.folder / 'run' / 'run_0.mcap'
    world.run(lambda: second.exists() and second.stat().st_size > 10_000, 'no second one')
    world.record._press()
    world.run(lambda: world.play.chooser.bag.name == 'run', 'the new one is not chosen')


def test_what_was_read_too_early_is_not_offered(
    world: World, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A reading that began before the recording ended, and ends after it, is not believed."""
    read, go_on = threading.Event(), threading.Event()
    look, offered = Shelf.look, set()

    def slow_look(shelf: Shelf) -> list[Bag]:
        bags = look(shelf)
        if bags and not read.is_set():
            read.set()
            go_on.wait(60.0)
            return [replace(each, problem='It is not finished.') for each in bags]
        return bags

    def is_offered() -> bool:
        offered.update(world.play.chooser._list.options)
        return world.play.chooser.bag is not None

    monkeypatch.setattr(Shelf, 'look', slow_look)
    world.talk()
    world.record._name.value = 'walk'
    world.record._press()
    world.run(read.is_set, 'nobody looks')
    world.record._press()
    world.run(lambda: world.record.path == '', 'the recording does not end')
    go_on.set()
    world.run(is_offered, 'the recording is not listed')
    assert not any('✖' in each for each in offered)


def test_record_refused(world: World) -> None:
    """A name that is taken, or no topic at all, is a sentence, and nothing starts."""
    (world.folder / 'walk').mkdir(parents=True)
    world.record._name.value = 'walk'
    world.record._press()
    assert "There is already a recording 'walk'" in world.record._text.content
    world.record._name.value = ''
    world.record._all.value = False
    world.record._press()
    assert 'No topic selected' in world.record._text.content
    assert world.record.path == ''


def test_record_fails(world: World) -> None:
    """What ends the recording early is said as the recorder says it."""
    world.record._name.value = 'x' * 300
    world.record._press()
    world.run(lambda: world.record.path == '', 'the recording does not end')
    assert world.record._text.content.startswith('✖ ')
    assert 'status' not in world.record._text.content
    assert world.record._button.label == 'Record'


@pytest.mark.parametrize('text', ['/ticks odd-names!', '/ticks --output /tmp/elsewhere', '-s x'])
def test_what_is_recorded_is_a_topic(world: World, text: str) -> None:
    """What is no name of a topic is refused: the recorder would take some for options."""
    world.record._all.value = False
    world.record._topics.value = text
    world.record._press()
    assert world.record.path == '' and 'is not a valid topic name' in world.record._text.content


def test_memory(world: World) -> None:
    """The last seconds can be saved while they go on being kept."""
    world.talk()
    memory = world.panel._memory
    memory._on.value = True
    memory._turn(True)
    world.run(lambda: memory._child.facts.get('messages', 0) > 50, 'nothing is kept')
    memory._save()
    world.run(lambda: '✔ Saved' in memory._result.content, 'nothing is saved')
    assert recorded(world)['/ticks'] > 20
    memory._on.value = False
    memory._turn(False)
    world.run(lambda: memory._child is None, 'it is still kept')
    assert memory._button.disabled


def test_play(world: World) -> None:
    """A recording is played without its commands, and the page says that it is recorded."""
    write_bag(world.folder / 'old', '/replayed', '/cmd_vel', count=200)
    world.listen('/replayed')
    world.listen('/cmd_vel')
    world.run(lambda: world.play.chooser.bag, 'the recording is not listed')
    assert 'Left out, as they command a robot: /cmd\\_vel' in world.play._text.content
    world.play._press('Play')
    world.run(lambda: len(world.heard) > 2, 'nothing is played')
    assert world.heard[:3] == ['0', '1', '2'] and world.buffer.clears == 1
    assert 'old. This is recorded, not live.' in world.status.items()[0][2]
    world.play._press('Pause')
    world.run(lambda: 'Paused' in world.play._text.content, 'it goes on')
    world.heard.clear()
    world.play._wish_time(15.0)
    world.run(lambda: '150' in world.heard, 'it does not jump')
    world.run(lambda: '15.0 s of 19.9 s' in world.play._text.content, 'it is elsewhere')
    world.play._wish_time(1.0)
    world.run(lambda: '10' in world.heard, 'it does not jump back')
    assert world.buffer.clears == 2
    assert world.heard == ['147', '148', '149', '150', '7', '8', '9', '10']
    world.play._press('Stop')
    world.run(lambda: world.play._child is None, 'it does not stop')
    assert world.status.items() == []


def test_play_mixed(world: World) -> None:
    """If a live node publishes the same, the page says that both are mixed, and who it is."""
    write_bag(world.folder / 'old', '/ticks', count=200)
    world.talk()
    world.run(lambda: world.play.chooser.bag, 'the recording is not listed')
    world.play._press('Play')
    world.run(lambda: 'talker publishes /ticks as well' in world.play._text.content, 'not said')
    world.run(lambda: 'mixed' in world.status.items()[0][2], 'the badge does not say so')


def test_play_broken(world: World) -> None:
    """A recording that cannot be read to its end is a sentence of the page."""
    write_bag(world.folder / 'old', '/replayed', count=200)
    world.run(lambda: world.play.chooser.bag, 'the recording is not listed')
    (file,) = (world.folder / 'old').glob('*.mcap')
    file.write_bytes(file.read_bytes()[:300])
    world.play._press('Play')
    world.run(lambda: '✖' in world.play._text.content, 'nothing is said')
    assert 'ros2 bag recover' in world.play._text.content
    assert world.status.items() == []


def test_nothing_outlives_a_kill(tmp_path: Path) -> None:
    """Even if the console is killed, its recorder ends, and the recording is complete."""
    folder = tmp_path / 'bag'
    with domain_id() as domain:
        environment = {**os.environ, 'ROS_DOMAIN_ID': str(domain)}
        environment['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
        parent = subprocess.Popen(
            [sys.executable, '-c', PARENT, str(folder)],
            stdout=subprocess.PIPE,
            text=True,
            env=environment,
        )
        assert parent.stdout is not None
        child = int(parent.stdout.readline())
        wait_until(lambda: list(folder.glob('*.mcap')), 'nothing is recorded')
        parent.send_signal(signal.SIGKILL)
        parent.wait()
        wait_until(lambda: not is_alive(child), 'the recorder is still there')
    assert (folder / 'metadata.yaml').exists()


def test_child_ends_though_signals_are_blocked(tmp_path: Path) -> None:
    """Who starts a program may have blocked signals; it ends in order all the same."""
    with domain_id() as domain, mock.patch.dict(os.environ, {'ROS_DOMAIN_ID': str(domain)}):
        before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
        try:
            child = Child('record', ['-o', str(tmp_path / 'bag'), '--all'])
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        wait_until(lambda: list((tmp_path / 'bag').glob('*.mcap')), 'nothing is recorded')
        child.close()
    assert child.failure == '' and (tmp_path / 'bag' / 'metadata.yaml').exists()


def test_scene_tape() -> None:
    """The page has how the scene was, and what was sent of it; it loads nothing."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        frame = page.viser.scene.add_frame('/robot')
        tape = SceneTape(page.viser, 30.0, 10**6)
        for number in range(10):
            frame.position = (number, 0, 0)
        before = tape.size_bytes
        page.viser.gui.add_markdown('not in the scene')
        assert 0 < before == tape.size_bytes
        html = tape.page('Tom & Jerry', 10**7).decode()
        assert '<title>Tom &amp; Jerry</title>' in html
        assert re.search(r'__VISER_EMBED_DATA__="[A-Za-z0-9+/=]{500,}"', html)
        tape.close()
        frame.position = (0, 1, 0)
        assert tape.size_bytes == before
        assert page.viser._websock_server._record_handles == []


def test_scene_tape_is_bounded() -> None:
    """Old reels go, and no more memory is used than allowed."""
    with (
        Page('test', PageSettings(token=NO_TOKEN)) as page,
        mock.patch('robot_console.recordings.scene_folder.time') as clock,
    ):
        clock.monotonic.return_value = 0.0
        frame = page.viser.scene.add_frame('/robot')
        tape = SceneTape(page.viser, 30.0, 10**6)
        for second in range(100):
            clock.monotonic.return_value = float(second)
            frame.position = (second, 0, 0)
            tape.look()
        assert 30.0 <= tape.length_s <= 36.0
        assert tape.size_bytes < 100_000
        tape._max_bytes = 50
        frame.position = (0, 0, 0)
        tape.look()
        assert tape.size_bytes == 0
        assert len(page.viser._websock_server._record_handles) == 1


def test_scene_tape_misses_nothing_between_reels() -> None:
    """What another thread sends while a reel follows the next is there once, and in order."""
    with (
        Page('test', PageSettings(token=NO_TOKEN)) as page,
        mock.patch('robot_console.recordings.scene_folder.REEL_S', 0.0),
    ):
        frame = page.viser.scene.add_frame('/robot')
        tape = SceneTape(page.viser, 60.0, 10**8)

        def send() -> None:
            for number in range(1, 501):
                frame.position = (number, 0, 0)

        sender = threading.Thread(target=send)
        sender.start()
        while sender.is_alive():
            tape.look()
        with mock.patch.object(tape, '_encoded', return_value='') as encoded:
            tape.page('test', 10**7)
        tape.close()
        _, sent, *_ = encoded.call_args.args
        positions = [message.position[0] for _, message in sent if hasattr(message, 'position')]
        assert positions == list(range(1, 501))


def test_scene_too_large() -> None:
    """A file that would be too large is refused, with both sizes."""
    with Page('test', PageSettings(token=NO_TOKEN)) as page:
        tape = SceneTape(page.viser, 30.0, 10**6)
        with pytest.raises(TooLarge, match=r'would have \d+\.\d MiB, but no more than 0.5'):
            tape.page('test', 512 * 1024)


def wait_until(predicate: Callable[[], Any], what: str) -> None:
    """Let time pass until something holds."""
    end_s = time.monotonic() + 60.0
    while not predicate():
        assert time.monotonic() < end_s, what
        time.sleep(0.05)


def is_alive(pid: int) -> bool:
    """Tell if a process runs, and is no mere entry of the table."""
    try:
        with open(f'/proc/{pid}/stat', 'rb') as file:
            return file.read().rpartition(b')')[2].split()[0] not in (b'Z', b'X')
    except OSError:
        return False


def test_what_is_found_too_late(world: World) -> None:
    """What is found in the folder after the panel was closed changes no widget that is gone."""
    world.panel.close()
    world.play.chooser._list.remove()
    write_bag(world.folder / 'late')
    world.play.chooser._look()
    world.context.queue.run()
