# SPDX-License-Identifier: Apache-2.0
"""The node with its page, where persons are played by events such as a browser sends."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import nan
from pathlib import Path
import threading
import time
from typing import Any

from joint_state_publisher_gui import joint_page
from joint_state_publisher_gui.joint_state_publisher_gui import FRAME_S, JointStatePublisherGui
from joint_state_publisher_gui.poses import pose_file
from publisher_probe import LATCHED, Probe
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from viser import GuiEvent

URDF = """<robot name="bot">
  <link name="base"/> <link name="upper"/> <link name="lower"/>
  <joint name="left_shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><limit lower="-1" upper="2"/>
  </joint>
  <joint name="left_elbow" type="continuous"><parent link="upper"/><child link="lower"/></joint>
</robot>
"""
Start = Callable[..., JointStatePublisherGui]


@pytest.fixture
def start(domain: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Start]:
    """Return what starts the node, with parameters, in a thread of its own."""
    monkeypatch.setenv('ROS_HOME', str(tmp_path))
    started: list[tuple[JointStatePublisherGui, SingleThreadedExecutor, threading.Thread]] = []
    is_over = threading.Event()

    def work(executor: SingleThreadedExecutor) -> None:
        while not is_over.is_set():
            executor.spin_once(timeout_sec=0.1)

    def start(*parameters: str) -> JointStatePublisherGui:
        words = [word for each in ('rate:=50', *parameters) for word in ('-p', each)]
        rclpy.init(args=['--ros-args', *words], domain_id=domain)
        node = JointStatePublisherGui()
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        thread = threading.Thread(target=work, args=(executor,))
        thread.start()
        started.append((node, executor, thread))
        return node

    yield start
    is_over.set()
    for node, executor, thread in started:
        thread.join()
        executor.shutdown()
        node.destroy_node()
        rclpy.shutdown()


@pytest.fixture
def gui(start: Start, probe: Probe) -> JointStatePublisherGui:
    """Return the node with the robot, which it has from the topic, and one source."""
    node = start('source_list:=[commands]')
    describe(probe, node, URDF)
    return node


def describe(probe: Probe, node: JointStatePublisherGui, text: str) -> None:
    """Publish a robot, and wait until the page has it."""
    before = node.joint_page.sliders
    probe.sender(String, '/robot_description', LATCHED).publish(String(data=text))
    probe.until(lambda: node.joint_page.sliders is not before, 'the page has no sliders')


def give(widget: Any, value: Any) -> None:
    """Do what viser does if a browser sends a value."""
    widget._impl.value = value
    for callback in widget._impl.update_cb:
        callback(GuiEvent(client=object(), client_id=0, target=widget))


def sliders(node: JointStatePublisherGui) -> dict[str, Any]:
    """Return the widgets of the sliders that are there."""
    return {row.slider.name: row.handle for row in node.joint_page.sliders.rows}


def says(probe: Probe, node: JointStatePublisherGui, text: str) -> None:
    """Wait until the page says something."""
    notices = node.joint_page.notice, node.joint_page.warnings
    probe.until(
        lambda: any(text in notice.content for notice in notices),
        f'the page does not say {text!r}',
    )


def test_sliders_move_joints(probe: Probe, gui: JointStatePublisherGui) -> None:
    """A slider that a person moves is published, and shows degrees; its end is the limit."""
    heard = probe.listen(JointState, '/joint_states')
    slider = sliders(gui)['left_elbow']
    assert (slider.min, slider.max, slider.label.split()[0]) == (-3.141, 3.141, 'elbow')
    give(slider, 0.785)
    probe.until(lambda: heard and list(heard[-1].position) == [0.0, 0.785], 'nothing moves')
    probe.until(lambda: '45°' in slider.label, 'no degrees')
    assert slider.value == 0.785
    give(sliders(gui)['left_shoulder'], 99.0)
    probe.until(lambda: list(heard[-1].position) == [2.0, 0.785], 'the limit was not kept')
    probe.until(lambda: sliders(gui)['left_shoulder'].value == 2.0, 'the page was not put right')


def test_sources_move_sliders(probe: Probe, gui: JointStatePublisherGui) -> None:
    """Sliders follow sources, whose values are published as they are, until a person moves one."""
    heard = probe.listen(JointState, '/joint_states')
    source = probe.sender(JointState, '/commands')
    slider = sliders(gui)['left_shoulder']
    probe.send_until(
        lambda: source.publish(probe.state(left_shoulder=5.0)),
        lambda: slider.value == 2.0,
        'the slider does not follow',
    )
    probe.until(lambda: heard and heard[-1].position[0] == 5.0, 'the value was changed')
    give(slider, 0.5)
    probe.until(lambda: heard[-1].position[0] == 0.5, 'nothing moves')
    probe.for_some_time(0.3)
    assert slider.value == heard[-1].position[0] == 0.5


def test_sliders_of_others(probe: Probe, gui: JointStatePublisherGui) -> None:
    """A panel of RViz moves joints through a topic, and the sliders of the page follow."""
    heard = probe.listen(JointState, '/joint_states')
    panel = probe.sender(JointState, '/joint_state_publisher/slider_positions')
    panel.publish(probe.state(left_elbow=0.5))
    probe.until(lambda: heard and list(heard[-1].position) == [0.0, 0.5], 'nothing moves')
    probe.until(lambda: sliders(gui)['left_elbow'].value == 0.5, 'the slider does not follow')


def test_a_slider_that_missed_something_agrees_in_the_end(
    probe: Probe, gui: JointStatePublisherGui
) -> None:
    """If a person and a source move a joint at once, page and joint do not stay apart."""
    slider = sliders(gui)['left_shoulder']
    give(slider, 0.5)
    slider._impl.value = 1.5
    probe.until(lambda: slider.value == 0.5, 'the slider is not where the joint is')


def test_numbers_that_are_none(probe: Probe, gui: JointStatePublisherGui) -> None:
    """Positions of NaN, and lists of different lengths, are named and change nothing."""
    heard = probe.listen(JointState, '/joint_states')
    source = probe.sender(JointState, '/commands')
    source.publish(probe.state(left_elbow=nan, left_shoulder=0.25))
    says(
        probe,
        gui,
        '/commands: the position of &#x27;left_elbow&#x27; is not a number, and is ignored.',
    )
    probe.until(lambda: heard and list(heard[-1].position) == [0.25, 0.0], 'the rest is missing')
    source.publish(JointState(name=['left_elbow'], position=[1.0, 2.0]))
    says(probe, gui, '/commands: a message has 1 names but 2 position values')
    give(sliders(gui)['left_elbow'], nan)
    give(sliders(gui)['left_elbow'], 0.5)
    probe.until(lambda: list(heard[-1].position) == [0.25, 0.5], 'nothing moves any more')


def test_buttons(probe: Probe, gui: JointStatePublisherGui) -> None:
    """Buttons move all joints, and their sliders."""
    heard = probe.listen(JointState, '/joint_states')
    give(gui.joint_page.all, 'Randomise')
    probe.until(lambda: heard and all(heard[-1].position), 'nothing moves')
    probe.until(lambda: all(each.value for each in sliders(gui).values()), 'no slider moves')
    give(gui.joint_page.all, 'no button')
    give(gui.joint_page.all, 'Zero')
    probe.until(lambda: list(heard[-1].position) == [0.0, 0.0], 'not at zero')
    give(gui.joint_page.all, 'Randomise')
    give(gui.joint_page.all, 'Centre')
    probe.until(lambda: not any(each.value for each in sliders(gui).values()), 'not centred')


def test_poses(probe: Probe, gui: JointStatePublisherGui, tmp_path: Path) -> None:
    """A pose is saved, loaded as far as the robot has its joints, and deleted."""
    poses = gui.joint_page.poses
    file = pose_file('bot', tmp_path / 'joint_state_publisher_gui')
    give(sliders(gui)['left_elbow'], 0.5)
    poses.name.value = '<b>bent'
    give(poses.keep, 'Save')
    says(probe, gui, f'The pose &#x27;&lt;b&gt;bent&#x27; is saved in {file}.')
    assert (poses.saved.options, poses.saved.value) == (('<b>bent',), '<b>bent')
    file.write_text(file.read_text() + '  gone: 1.0\n')
    give(gui.joint_page.all, 'Zero')
    give(poses.use, 'Load')
    says(probe, gui, '&#x27;gone&#x27; is skipped: it is not a moving joint of this robot.')
    probe.until(lambda: sliders(gui)['left_elbow'].value == 0.5, 'the pose is not loaded')
    give(poses.use, 'Delete')
    says(probe, gui, 'is deleted.')
    assert poses.saved.options == ('(none saved)',)
    file.write_text('- broken')
    give(poses.keep, 'Save')
    says(probe, gui, 'cannot be used, and is left unchanged: it must map names to poses.')
    assert file.read_text() == '- broken'


def test_nothing_to_load(probe: Probe, gui: JointStatePublisherGui) -> None:
    """Without a pose, loading and deleting say so."""
    give(gui.joint_page.poses.use, 'Load')
    says(probe, gui, 'There is no pose')
    give(gui.joint_page.all, 'Zero')
    gui.joint_page.notice.say('')
    give(gui.joint_page.poses.use, 'Delete')
    says(probe, gui, 'There is no pose')


def test_warnings_end(
    probe: Probe, gui: JointStatePublisherGui, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What a source does wrong is said for some time, beside what is said of other things."""
    monkeypatch.setattr(joint_page, 'WARNED_FRAMES', 15)
    probe.sender(JointState, '/commands').publish(probe.state(left_elbow=nan))
    probe.until(lambda: gui.joint_page.warnings.content, 'the page does not warn')
    says(probe, gui, 'bot: 2 joints')
    probe.until(lambda: not gui.joint_page.warnings.content, 'the page still warns')


def test_silent_topics(probe: Probe, start: Start) -> None:
    """The page says which robot and which sources it has not heard of."""
    node = start('source_list:=[commands]')
    says(probe, node, 'Nothing received on /commands so far: it has no publisher.')
    says(probe, node, 'Nothing received on /robot_description so far: it has no publisher.')
    says(probe, node, 'Waiting for robot_description')
    describe(probe, node, URDF)
    says(probe, node, 'bot: 2 joints')
    assert not node.joint_page.warnings.content


def test_robots_without_joints_and_with_many(probe: Probe, gui: JointStatePublisherGui) -> None:
    """A robot without joints has a sentence; of very many joints the page has some."""
    describe(probe, gui, '<robot name="rock"><link name="base"/></robot>')
    says(probe, gui, 'rock: 0 joints')
    many = ''.join(
        f'<link name="l{n}"/><joint name="j{n}" type="continuous"><parent link="base"/>'
        f'<child link="l{n}"/></joint>'
        for n in range(300)
    )
    describe(probe, gui, f'<robot name="many"><link name="base"/>{many}</robot>')
    says(probe, gui, 'many: 300 joints')
    assert len(sliders(gui)) == 200
    give(gui.joint_page.sliders.search, 'j299')
    probe.until(lambda: list(sliders(gui)) == ['j299'], 'not found')


def test_search(probe: Probe, gui: JointStatePublisherGui) -> None:
    """Only the sliders that are found are there; those that come back show what has happened."""
    search = gui.joint_page.sliders.search
    give(sliders(gui)['left_elbow'], 0.5)
    give(search, 'shoulder')
    probe.until(lambda: list(sliders(gui)) == ['left_shoulder'], 'not found')
    give(search, 'nothing')
    probe.until(lambda: not sliders(gui), 'something was found')
    give(search, '')
    probe.until(lambda: len(sliders(gui)) == 2, 'sliders are missing')
    assert sliders(gui)['left_elbow'].value == 0.5


def test_new_robots_replace_the_page(probe: Probe, gui: JointStatePublisherGui) -> None:
    """A broken description is named; a new one has new sliders, and old ones harm nothing."""
    old, poses = sliders(gui), gui.joint_page.poses
    search = gui.joint_page.sliders.search
    sender = probe.sender(String, '/robot_description', LATCHED)
    sender.publish(String(data='<robot/>'))
    says(probe, gui, 'A robot description is ignored.')
    assert sliders(gui) == old
    describe(probe, gui, URDF.replace('left_elbow', 'right_elbow'))
    assert list(sliders(gui)) == ['left_shoulder', 'right_elbow']
    for widget, value in ((old['left_shoulder'], 1.0), (poses.keep, 'Save'), (search, 'x')):
        give(widget, value)
    heard = probe.listen(JointState, '/joint_states')
    give(sliders(gui)['right_elbow'], 0.25)
    probe.until(lambda: heard and heard[-1].position[1] == 0.25, 'nothing moves any more')
    assert heard[-1].position[0] == 0.0


def test_only_what_changes_is_sent(probe: Probe, gui: JointStatePublisherGui) -> None:
    """A joint that rests costs nothing, and one that moves at most ten updates a second."""
    sent: list[Any] = []
    handles = sliders(gui)
    for handle in handles.values():
        handle.on_update(sent.append)
    source = probe.sender(JointState, '/commands')
    begin_s = time.monotonic()
    for step in range(100):
        source.publish(probe.state(left_elbow=step / 100, left_shoulder=0.0))
        probe.for_some_time(0.01)
    probe.until(lambda: handles['left_elbow'].value == 0.99, 'the slider does not follow')
    assert all(event.target is handles['left_elbow'] for event in sent)
    assert len(sent) <= (time.monotonic() - begin_s) / FRAME_S + 2
