# SPDX-License-Identifier: Apache-2.0
"""Tests of messages as text; the fast writer of YAML agrees with PyYAML, to the letter."""

import random
from typing import Any

from geometry_msgs.msg import PoseWithCovariance
import pytest
from ros2cli.messages.lookup import get_message, UnknownType
from ros2cli.messages.text import (
    dump,
    NeedsPyYaml,
    plain_to_yaml,
    Shortening,
    to_block_yaml,
    to_csv,
    to_plain,
    to_yaml,
)
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import ByteMultiArray, Header, String

JOINTS = JointState(header=Header(frame_id='torso'), name=['left', 'right'], position=[0.25, -0.5])

NAMES = ('x', 'y', 'on', 'no', 'null', 'frame_id', 'data', 'position', 'true')
TEXTS = (
    '', ' ', 'torso', 'left_ankle_roll', '/robot1/tf', 'true', 'null', 'no', 'on', 'y', '1',
    '1.5', '0x10', '1e3', '1_000', '.inf', '12:30:45', '2020-01-01', 'a: b', 'a #b', '#a', '- a',
    '-', '?', "it's", '"', "'...'", '...', '---', '[a]', '{a}', '*a', '&a', '!a', '%a', '@a',
    '`a', '<<', '=', 'größe', '漢字', '\x01', '\t', ' a', 'a ', 'a\\b', '\x85', '\u2028',
    '\ufeff', '😀', '~', 'a,b',
)  # fmt: skip
NUMBERS = (
    0, -1, 2**64 - 1, 0.0, -0.0, 0.1, 1e-7, 1e16, 1.5e300, 1e22, -2.5e-9, float('inf'),
    float('-inf'), True, False,
)  # fmt: skip


def test_yaml_is_block_style_in_order_of_fields() -> None:
    """Each field is a line in the order of the definition; empty texts and arrays show."""
    assert to_yaml(JOINTS) == (
        'header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: torso\n'
        'name:\n- left\n- right\nposition:\n- 0.25\n- -0.5\nvelocity: []\neffort: []\n'
    )
    assert to_yaml(String()) == "data: ''\n"


def test_yaml_is_neither_wrapped_nor_escaped() -> None:
    """Long texts stay on one line and letters of all languages stay readable."""
    text = 'größe ' * 60 + 'x'
    assert to_yaml(String(data=text)) == f'data: {text}\n'


def test_flow_style_is_one_line() -> None:
    """Flow style writes collections in brackets."""
    assert to_yaml(JOINTS.header.stamp, flow_style=True) == '{sec: 0, nanosec: 0}\n'


def test_csv_is_depth_first() -> None:
    """All values follow each other with commas."""
    assert to_csv(JOINTS) == '0,0,torso,left,right,0.25,-0.5'


def test_long_values_are_cut() -> None:
    """Texts and arrays longer than the limit end with dots; shorter ones are complete."""
    plain = to_plain(Image(encoding='rgb8', data=bytes(range(9))), Shortening(length=4))
    assert plain['data'] == [0, 1, 2, 3, '...']
    assert plain['encoding'] == 'rgb8'
    assert to_plain(String(data='12345'), Shortening(length=4)) == {'data': '1234...'}


def test_arrays_and_texts_can_be_hidden() -> None:
    """Hidden arrays show their type and length, hidden texts their length."""
    plain = to_plain(JOINTS, Shortening(hide_arrays=True, hide_strings=True))
    assert plain['name'] == '<sequence type: string, length: 2>'
    assert plain['position'] == '<sequence type: float64, length: 2>'
    assert plain['header']['frame_id'] == '<string length: <5>>'
    pose = to_plain(PoseWithCovariance(), Shortening(hide_arrays=True))
    assert pose['covariance'] == '<array type: float64[36]>'


def test_bytes_are_latin_text() -> None:
    """A field of bytes is shown as text, byte by byte."""
    assert to_plain(ByteMultiArray(data=[b'a', b'\xe4']))['data'] == ['a', 'ä']


def test_info_is_sorted() -> None:
    """A mapping is shown in the order of its names."""
    assert list(to_plain({'b': 1, 'a': 2})) == ['a', 'b']


@pytest.mark.parametrize('name', ['sensor_msgs/msg/JointState', 'sensor_msgs/JointState'])
def test_type_is_found(name: str) -> None:
    """A type is found by its full name and by the short one."""
    assert get_message(name) is JointState


@pytest.mark.parametrize(
    ('name', 'reason'),
    [
        ('JointState', 'not of the form'),
        ('sensor_msgs/srv/JointState', 'not of the form'),
        ('../msg/x', 'not of the form'),
        ('nope_msgs/msg/Nope', "the package 'nope_msgs' .* cannot be imported"),
        ('sensor_msgs/msg/JointStat', "has no type 'JointStat'. Did you mean 'JointState'?"),
    ],
)
def test_unknown_type_says_why(name: str, reason: str) -> None:
    """An unknown type is an error that names the part which is wrong."""
    with pytest.raises(UnknownType, match=reason):
        get_message(name)


def random_value(source: random.Random, depth: int) -> Any:
    """Return a scalar, or a list or mapping of values."""
    kind = source.choice(['text', 'number', 'list', 'dict'] if depth else ['text', 'number'])
    if kind == 'text':
        return source.choice(TEXTS)
    if kind == 'number':
        return source.choice(NUMBERS)
    count = source.randrange(4)
    if kind == 'list':
        return [random_value(source, depth - 1) for _ in range(count)]
    return {source.choice(NAMES): random_value(source, depth - 1) for _ in range(count)}


@pytest.mark.parametrize('seed', range(10))
def test_random_values_are_written_as_pyyaml_does(seed: int) -> None:
    """Nested mappings and lists of all kinds of scalars come out the same."""
    source = random.Random(seed)
    for _ in range(300):
        plain = {'first': random_value(source, 4), 'list': [random_value(source, 3)]}
        assert plain_to_yaml(plain) == dump(plain, flow_style=False)


@pytest.mark.parametrize('scalar', [*TEXTS, *NUMBERS, float('nan'), 'a\nb', None, b'a'])
def test_scalars_are_written_as_pyyaml_does(scalar: Any) -> None:
    """Each scalar is quoted as it must be, as a value, as an item, and alone."""
    for plain in ({'a': scalar}, [scalar], {'a': [{'b': scalar}]}, scalar):
        assert plain_to_yaml(plain) == dump(plain, flow_style=False)


def test_text_of_several_lines_is_left_to_pyyaml() -> None:
    """What depends on the indentation is not attempted."""
    with pytest.raises(NeedsPyYaml):
        to_block_yaml({'a': 'first\nsecond'})
