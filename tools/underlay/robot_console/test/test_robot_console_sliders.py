# SPDX-License-Identifier: Apache-2.0
"""The panel with the sliders of a joint_state_publisher_gui."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from live_world import Browser, live_world, LiveWorld
import pytest
from robot_console import remote_sliders
from robot_console.panels.sliders import Sliders
from slider_node import SliderNode, URDF


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[LiveWorld]:
    """Return a page, whose saved poses are in a folder of the test."""
    monkeypatch.setenv('ROS_HOME', str(tmp_path))
    with live_world() as world:
        yield world


def value_of(page: Browser, name: str) -> float | None:
    """Return the newest value of a slider that the page was told."""
    told = [each['values'][name] for each in page.told if name in each.get('values', {})]
    return told[-1] if told else None


def test_comes_and_goes_with_the_node(world: LiveWorld) -> None:
    """Without the node the panel is not wanted, and says what is missing; so it does again."""
    page = world.visit('sliders')
    missing = "no node subscribes to '/joint_state_publisher/slider_positions'"
    page.wait_for('problem', lambda problem: missing in problem)
    page.ask('move', name='left_elbow', value=0.5)
    page.wait_for('refusal', lambda refusal: missing in refusal)
    assert not Sliders.is_wanted(world.node)
    node = SliderNode(world)
    page.wait_for('limbs')
    assert Sliders.is_wanted(world.node)
    page.told.clear()
    node.end(world)
    told = page.wait_for('problem', lambda problem: missing in problem)
    assert told['limbs'] == []


def test_ranges_and_defaults(world: LiveWorld) -> None:
    """Limits are those of the description, and defaults those of the parameters of the node."""
    SliderNode(world, left_elbow=0.75)
    page = world.visit('sliders')
    arm, other = page.wait_for('limbs')['limbs']
    assert (arm['title'], other['title']) == ('Left arm', 'Joints')
    (elbow,), (lift,) = arm['sliders'], other['sliders']
    assert (elbow['label'], elbow['ends'], elbow['isAngle']) == ('elbow', [-1.0, 2.0], True)
    assert (lift['ends'], lift['isAngle']) == ([0.0, 0.5], False)
    told = page.wait_for('values', lambda values: len(values) == 2)
    assert told['values'] == {'left_elbow': 0.75, 'lift': 0.0}


def test_a_slider_moves_its_joint(world: LiveWorld, monkeypatch: pytest.MonkeyPatch) -> None:
    """The position is sent, within the limits; older joint states do not move the slider back."""
    node = SliderNode(world)
    page = world.visit('sliders')
    page.wait_for('limbs')
    node.say_until(world, lambda: value_of(page, 'left_elbow') == 0.25, left_elbow=0.25)
    monkeypatch.setattr(remote_sliders, 'HOLD_S', 1000.0)
    page.ask('move', name='left_elbow', value=9.0)
    world.wait_until(lambda: node.sent == [{'left_elbow': 2.0}], 'not sent', node.sent)
    page.told.clear()
    node.say_until(world, lambda: value_of(page, 'lift') == 0.125, left_elbow=0.25, lift=0.125)
    assert value_of(page, 'left_elbow') in (None, 2.0)
    node.say_until(world, lambda: value_of(page, 'lift') == 0.5, left_elbow=2.0, lift=0.5)
    node.say_until(world, lambda: value_of(page, 'left_elbow') == 0.5, left_elbow=0.5)


@pytest.mark.parametrize(
    ('asked', 'refusal'),
    [
        ({'name': 'gone', 'value': 0.0}, 'This slider no longer exists.'),
        ({'name': 'lift', 'value': 'x'}, "The position of 'lift' must be a number."),
        ({'name': 'lift', 'value': 10**400}, "The position of 'lift' must be a number."),
    ],
)
def test_positions_that_are_none(world: LiveWorld, asked: dict[str, object], refusal: str) -> None:
    """Nothing is sent, and the page is told why."""
    node = SliderNode(world)
    page = world.visit('sliders')
    page.wait_for('limbs')
    page.ask('move', **asked)
    assert page.wait_for('refusal')['refusal'] == refusal
    page.ask('move', name='lift', value=0.25)
    world.wait_until(lambda: bool(node.sent), 'not sent')
    assert node.sent == [{'lift': 0.25}]


def test_all_joints(world: LiveWorld) -> None:
    """Buttons send all joints: to their defaults, to zero, or anywhere within the limits."""
    node = SliderNode(world, left_elbow=0.75)
    page = world.visit('sliders')
    page.wait_for('limbs')
    for how in ('zero', 'centre', 'randomise'):
        page.ask('all', how=how)
    world.wait_until(lambda: len(node.sent) == 3, 'not sent')
    assert node.sent[:2] == [{'left_elbow': 0.0, 'lift': 0.0}, {'left_elbow': 0.75, 'lift': 0.0}]
    assert -1.0 < node.sent[2]['left_elbow'] < 2.0 and 0.0 < node.sent[2]['lift'] < 0.5


def test_poses(world: LiveWorld, tmp_path: Path) -> None:
    """A pose is saved in the file of the robot, loaded and deleted; each says so."""
    node = SliderNode(world)
    page = world.visit('sliders')
    page.wait_for('limbs')
    node.say_until(world, lambda: value_of(page, 'lift') == 0.25, lift=0.25)
    page.ask('save', name=' up ')
    page.wait_for('poses', lambda poses: poses == ['up'])
    file = tmp_path / 'joint_state_publisher_gui' / 'arm.yaml'
    assert file.read_text() == 'up:\n  left_elbow: 0.0\n  lift: 0.25\n'
    file.write_text(file.read_text() + '  gone: 1.0\n')
    page.ask('load', name='up')
    told = page.wait_for('said', lambda said: 'is loaded' in said[0])
    assert "'gone' is skipped: it is not a moving joint" in told['said'][1]
    world.wait_until(lambda: node.sent == [{'left_elbow': 0.0, 'lift': 0.25}], 'not sent')
    page.told.clear()
    page.ask('delete', name='up')
    page.wait_for('poses', lambda poses: poses == [])
    page.ask('save', name='')
    page.wait_for('refusal', lambda refusal: 'give it a name first' in refusal)
    file.write_text('- broken')
    page.wait_for('posesProblem', lambda problem: 'it must map names to poses' in problem)


def test_a_description_that_is_wrong(world: LiveWorld) -> None:
    """The page says what is wrong, until the description is right."""
    node = SliderNode(world, '<robot/>')
    page = world.visit('sliders')
    page.wait_for('problem', lambda problem: 'robot' in problem and 'Asking' not in problem)
    assert all(each.get('limbs') in (None, []) for each in page.told)
    node.describe(URDF)
    assert page.wait_for('limbs')['problem'] == ''
