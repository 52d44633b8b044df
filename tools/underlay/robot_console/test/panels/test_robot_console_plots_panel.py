# SPDX-License-Identifier: Apache-2.0
"""The panel of plots hears topics, draws them, and offers what can be plotted."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import msgspec
import pytest
from rclpy.node import Node
from robot_console.panels.plots_panel import CLEAR, CSV, PAUSE, PlotsPanel
from robot_console.plots.series_chooser import EFFORT, IMU, TRACKING
from robot_console.plots.topic_listener import TopicListener
from rviz_common.inputs import WorkQueue
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import String

Work = Callable[..., None]


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Return what is sent of curves, as the browser reads it."""
    from viser._gui_handles import GuiUplotHandle

    sent: list[Any] = []
    before = GuiUplotHandle._queue_update

    def keep(handle: Any, name: str, value: Any) -> None:
        if name == 'data':
            sent.append([msgspec.msgpack.decode(bytes(each)) for each in value])
        before(handle, name, value)

    monkeypatch.setattr(GuiUplotHandle, '_queue_update', keep)
    return sent


@pytest.fixture
def robot(robot_node: Node) -> Callable[[], None]:
    """Return what has a robot move: two joints, one of them commanded."""
    states = robot_node.create_publisher(JointState, 'joint_states', 10)
    commands = robot_node.create_publisher(JointState, 'joint_commands', 10)
    imus = robot_node.create_publisher(Imu, 'torso/imu', 10)
    robot_node.create_publisher(String, 'words', 10)

    def move() -> None:
        states.publish(JointState(name=['hip', 'knee'], position=[0.25, 1.0], effort=[1.0, -2.0]))
        commands.publish(JointState(name=['knee'], position=[1.5]))
        imus.publish(Imu())

    return move


def listed(panel: Any) -> list[str]:
    """Return the series that are plotted."""
    return [str(each.series) for each in panel._board.plotted]


def newest(panel: Any) -> list[float | None]:
    """Return the newest values."""
    return [each.trace.newest for each in panel._board.plotted]


def press(panel: Any, button: str, client: Any = None) -> None:
    """Press a button of the plot."""
    target = SimpleNamespace(value=button)
    panel._press(SimpleNamespace(target=target, client=client))
    panel.context.queue.run()


def test_series_of_the_file(
    show_panel: Any, work_until: Work, robot: Callable[[], None], drawn: list[Any]
) -> None:
    """Series of the file are plotted, with gaps where nothing is known."""
    text = 'joint_states.position[knee]; joint_commands.position[knee] - joint_states.position[1]'
    panel = show_panel(PlotsPanel, Series=text, Window=60.0)
    work_until(panel, lambda: newest(panel) == [1.0, 0.5], robot)
    work_until(panel, lambda: 0.5 in drawn[-1][2], robot)
    times, one, two = drawn[-1]
    assert (times[0], times[-1], len(times)) == (-60.0, 0.0, len(one))
    assert one[0] is None and two[0] is None
    assert panel.to_file()['Series'] == text


def test_messages_keep_their_order(robot_node: Node, work_until: Work) -> None:
    """Messages of several topics are looked at in the order in which they came."""
    heard: list[str] = []
    listener = TopicListener(
        robot_node,
        robot_node.resolve_topic_name,
        lambda topic, kind: None,
        lambda topic, message, time_s: heard.append(message.data),
    )
    publishers = [robot_node.create_publisher(String, topic, 10) for topic in ('one', 'two')]
    idle = SimpleNamespace(context=SimpleNamespace(queue=WorkQueue()), update=lambda: None)
    work_until(idle, lambda: not listener.listen(('one', 'two')))
    work_until(idle, lambda: all(each.get_subscription_count() for each in publishers))
    for number in range(4):
        publishers[number % 2].publish(String(data=str(number)))
    work_until(idle, lambda: len(heard) == 4, listener.take_all)
    assert heard == ['0', '1', '2', '3']
    listener.close()


def test_nobody_publishes(show_panel: Any, work_until: Work) -> None:
    """A topic that nobody publishes is named; so is a path that cannot be read."""
    panel = show_panel(PlotsPanel, Series='nothing.x')
    work_until(panel, lambda: 'No publisher on /nothing.' in panel._legend.content)
    broken = show_panel(PlotsPanel, Series='nothing')
    assert (
        'Series of the file: &#x27;nothing&#x27; names no message' in broken._chooser._said.content
    )


def test_only_heard(show_panel: Any, work_until: Work, robot_node: Node) -> None:
    """A topic that others only hear is not taken for one that is published."""
    robot_node.create_subscription(JointState, 'states', lambda message: None, 10)
    panel = show_panel(PlotsPanel, Series='states.position[0]')
    work_until(panel, lambda: 'No publisher on /states.' in panel._legend.content)
    states = robot_node.create_publisher(JointState, 'states', 10)
    message = JointState(name=['knee'], position=[1.0])
    work_until(panel, lambda: newest(panel) == [1.0], lambda: states.publish(message))
    work_until(panel, lambda: 'Nobody' not in panel._legend.content)
    robot_node.destroy_subscription(next(iter(robot_node.subscriptions)))


def test_wrong_field(show_panel: Any, work_until: Work, robot: Callable[[], None]) -> None:
    """A field that a topic does not have is explained as soon as its type is known."""
    panel = show_panel(PlotsPanel, Series='joint_states.positon[0]')
    work_until(panel, lambda: 'Did you mean' in panel._legend.content, robot)


def test_offers(show_panel: Any, work_until: Work, robot: Callable[[], None]) -> None:
    """Topics with numbers are offered, then their fields with the names of joints."""
    panel = show_panel(PlotsPanel)
    chooser = panel._chooser
    work_until(panel, lambda: 'torso/imu' in chooser._topic.options, robot)
    assert 'words' not in chooser._topic.options
    chooser._topic.value = 'joint_states'
    chooser._choose_topic('joint_states')
    assert 'position[0]' in chooser._field.options
    work_until(panel, lambda: 'position[knee]' in chooser._field.options, robot)
    chooser._choose_field('position[knee]')
    assert listed(panel) == ['joint_states.position[knee]']
    assert chooser._listed.options[1:] == ('joint_states.position[knee]',)
    chooser._remove('joint_states.position[knee]')
    assert listed(panel) == []


def test_written_path(show_panel: Any) -> None:
    """A path can be written; a broken one is refused with a sentence in the page."""
    panel = show_panel(PlotsPanel)
    chooser = panel._chooser
    chooser._path.value = 'joint_states.'
    chooser._add_path()
    assert 'is not valid at' in chooser._said.content
    chooser._path.value = 'joint_states.position[0]'
    chooser._add_path()
    assert chooser._said.content == '' and listed(panel) == ['joint_states.position[0]']


@pytest.mark.parametrize('topic', ['32FC1', 'a//b', '/a/1b', '', '~x', 'x' * 300])
def test_what_is_no_name_of_a_topic(show_panel: Any, work_until: Work, topic: str) -> None:
    """Whatever text a page sends as a topic is answered with a sentence; the panel goes on."""
    panel = show_panel(PlotsPanel)
    chooser = panel._chooser
    chooser._choose_topic(topic)
    assert 'no longer has a publisher' in chooser._said.content
    chooser._path.value = f'{topic}.position[0]'
    chooser._add_path()
    said = [chooser._said.content]
    work_until(panel, lambda: 'topic' in f'{said}{panel._legend.content}')


@pytest.mark.parametrize(
    ('preset', 'series'),
    [
        (TRACKING, ['joint_commands.position[knee] - joint_states.position[knee]']),
        (EFFORT, ['joint_states.effort[hip]', 'joint_states.effort[knee]']),
        (IMU, ['torso/imu.angular_velocity.x']),
    ],
)
def test_presets(
    show_panel: Any,
    work_until: Work,
    robot: Callable[[], None],
    preset: str,
    series: list[str],
) -> None:
    """A preset plots what the robot that is there has of it."""
    panel = show_panel(PlotsPanel)
    work_until(panel, lambda: 'torso/imu' in panel._chooser._topic.options, robot)
    panel._chooser._presets.choose(preset)
    work_until(panel, lambda: listed(panel)[: len(series)] == series, robot)
    work_until(panel, lambda: None not in newest(panel), robot)


def test_preset_without_robot(show_panel: Any, work_until: Work) -> None:
    """A preset that has nothing to show says what it needs."""
    panel = show_panel(PlotsPanel)
    panel._chooser._presets.choose(TRACKING)
    sentence = 'No message received on /joint_states and /joint_commands; the preset needs one.'
    work_until(panel, lambda: sentence in panel._chooser._said.content)


def test_buttons(
    show_panel: Any, work_until: Work, robot: Callable[[], None], drawn: list[Any]
) -> None:
    """A plot can rest, go on, be saved and be cleared."""
    panel = show_panel(PlotsPanel, Series='joint_states.position[knee]')
    work_until(panel, lambda: newest(panel) == [1.0], robot)
    press(panel, PAUSE)
    assert panel._buttons.options[0] == 'Continue'
    count = len(drawn)
    panel.update()
    assert len(drawn) == count
    files: dict[str, bytes] = {}
    press(panel, CSV, SimpleNamespace(send_file_download=files.__setitem__))
    [(name, text)] = files.items()
    assert name.endswith('.csv') and text.startswith(b'time_s,joint_states.position[knee]\n')
    assert text.rstrip().endswith(b',1.0')
    press(panel, CLEAR)
    assert newest(panel) == [None] and panel._buttons.options[0] == PAUSE
