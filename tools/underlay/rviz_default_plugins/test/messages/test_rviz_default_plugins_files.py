# SPDX-License-Identifier: Apache-2.0
"""Displays as files have them, and messages that nobody should send."""

import random
import textwrap

from genuine_displays import GENUINE
from message_stage import all_sentences
import numpy as np
import pytest
from rviz_common.plugins import DISPLAYS, load_plugin, plugin_names
from rviz_common.properties import Topic
from std_msgs.msg import Header
import yaml


@pytest.mark.parametrize('name', GENUINE)
def test_files_of_rviz_are_understood(message_stage, name):
    """Each property that RViz writes is known and taken, and is written back as it was."""
    given = yaml.safe_load(textwrap.dedent(GENUINE[name]))
    display = message_stage.show(load_plugin(DISPLAYS, name), given)
    assert display.unknown == []
    assert display.values.refusals == []
    assert display.to_file() == given
    assert message_stage.node.subscriptions[0][0] == '/topic'
    assert message_stage.node.subscriptions[0][2].reliability.name == 'BEST_EFFORT'


@pytest.mark.parametrize('name', GENUINE)
def test_properties_are_described(name):
    """Each property has a default that can be used, and is described."""
    for each in load_plugin(DISPLAYS, name).PROPERTIES:
        assert each.read(each.default) == each.default
        assert each.description, each.path


def test_all_displays_are_found():
    """Each class is offered as entry point under its name, and each with messages is tested."""
    found = {name: load_plugin(DISPLAYS, name) for name in plugin_names(DISPLAYS)}
    own = {
        name: kind
        for name, kind in found.items()
        if name.startswith(('rviz_default_plugins/', 'rviz_imu_plugin/'))
    }
    assert all(name == kind.CLASS for name, kind in own.items())
    assert {name for name, kind in own.items() if hasattr(kind, 'MESSAGE')} == set(GENUINE)


@pytest.mark.parametrize('name', GENUINE)
def test_types_of_topics_are_those_of_messages(name):
    """The type that a topic is offered for is that of the messages."""
    kind = load_plugin(DISPLAYS, name)
    topic = next(each for each in kind.PROPERTIES if isinstance(each, Topic))
    package, _, last = kind.MESSAGE.__module__.partition('.')
    assert topic.type_name == f'{package}/msg/{kind.MESSAGE.__name__}'
    assert last


@pytest.mark.parametrize('name', GENUINE)
def test_no_topic_and_a_wrong_one(message_stage, name):
    """Without a topic, or with one that cannot be, a display says so."""
    kind = load_plugin(DISPLAYS, name)
    empty = message_stage.show(kind, {'Topic': {'Value': ''}})
    empty.update()
    assert 'No topic selected' in all_sentences(empty)
    wrong = message_stage.show(kind, {'Topic': {'Value': '/a b'}})
    wrong.update()
    assert "'/a b' cannot be subscribed" in all_sentences(wrong)


NUMBERS = (
    0.0,
    0.5,
    1.0,
    2.0,
    -1.0,
    1e30,
    -1e300,
    1e-30,
    float('nan'),
    float('inf'),
    float('-inf'),
)
WHOLES = (0, 1, 2, 3, 5, 7, 16, 100)
TEXTS = ('', 'map', 'nowhere', '/map', 'rgb8', '32FC1', 'bayer_rggb8', 'yuv422', 'x', 'y', 'z')


def garbled(kind, dice, depth=0):
    """Return a message of random fields, many of which make no sense together."""
    message = kind()
    for field, type_name in kind.get_fields_and_field_types().items():
        value = getattr(message, field)
        if dice.random() < 0.15 and depth < 3:
            continue
        try:
            setattr(message, field, anything(value, type_name, dice, depth))
        except AssertionError:  # out of the range of the field
            continue
    return message


def anything(value, type_name, dice, depth):
    """Return a value of a type that a message may have."""
    if isinstance(value, bool):
        return dice.random() < 0.5
    if isinstance(value, float):
        return dice.choice(NUMBERS)
    if isinstance(value, int):
        return dice.choice(WHOLES)
    if isinstance(value, str):
        return dice.choice(TEXTS)
    if isinstance(value, np.ndarray):
        return np.array([dice.choice(NUMBERS) for _ in value])
    if hasattr(value, 'get_fields_and_field_types'):
        return garbled(type(value), dice, depth + 1)
    return several(type_name, dice, depth)


def several(type_name, dice, depth):
    """Return a list for a sequence."""
    count = dice.choice((0, 1, 2, 3, 12))
    inner = type_name.removeprefix('sequence<').removesuffix('>')
    if '/' in inner:
        package, name = inner.split('/')
        module = __import__(f'{package}.msg', fromlist=[name])
        return [garbled(getattr(module, name), dice, depth + 1) for _ in range(count)]
    if inner.startswith(('float', 'double')):
        return [dice.choice(NUMBERS) for _ in range(count)]
    if inner == 'string':
        return [dice.choice(TEXTS) for _ in range(count)]
    return [dice.choice(WHOLES) for _ in range(count * dice.choice((1, 4, 12)))]


@pytest.mark.parametrize('name', GENUINE)
def test_garbled_messages_do_no_harm(message_stage, name, monkeypatch):
    """Random messages may have sentences, but never stop a display."""
    kind = load_plugin(DISPLAYS, name)
    dice = random.Random(name)
    clock = iter(range(10000))
    monkeypatch.setattr(kind, 'now_s', lambda _: next(clock), raising=False)
    display = message_stage.listen(kind)
    if name.endswith('Camera'):
        message_stage.node.say('/camera_info', camera_info())
    for _ in range(60):
        message = garbled(kind.MESSAGE, dice)
        if hasattr(message, 'header') and dice.random() < 0.8:
            message.header = Header(frame_id='map')
        message_stage.node.say('/topic', message)
        display.update()
        check_scene(message_stage)
        for subject, _, said in display.status.items():
            assert said.strip(), subject
    assert display.received == 60


def check_scene(stage):
    """Check that a browser can draw all that there is."""
    for path in stage.paths():
        node = stage.node_at(path)
        assert np.isfinite(node.position).all(), path
        assert np.linalg.norm(node.wxyz) == pytest.approx(1.0, abs=1e-3), path
        for name, value in vars(node._impl.props).items():
            if isinstance(value, (np.ndarray, float, tuple)):
                assert np.isfinite(np.asarray(value, dtype=float)).all(), (path, name)


def camera_info():
    """Return what is known of a camera."""
    from sensor_msgs.msg import CameraInfo

    info = CameraInfo(width=4, height=4)
    info.k[0] = info.k[4] = 4.0
    return info
