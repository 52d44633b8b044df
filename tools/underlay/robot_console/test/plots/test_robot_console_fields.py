# SPDX-License-Identifier: Apache-2.0
"""Paths of numbers in messages: how they are written, and what they lead to."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from plot_messages import schema, state, transforms, vector
import pytest
from robot_console.plots.field_reader import FieldReader
from robot_console.plots.fields import completions
from robot_console.plots.series import parse_all, parse_path, parse_series, PathError

IMU = SimpleNamespace(turn=vector(1.5, 2.5), covariance=(0.1, 0.2), is_on=True, raw=b'\x07')
TRAJECTORY = SimpleNamespace(
    joint_names=['hip', 'knee'], points=[SimpleNamespace(positions=[0.5, 0.75])]
)


def read(path: str, kind: str, message: Any) -> float:
    """Return what is at a path of a message."""
    return FieldReader(parse_path(path), kind, schema).read(message)


@pytest.mark.parametrize(
    'path', ['joint_states.position[left_knee]', '/a/b.c.d[0][-1].e', 'imu.covariance[1]', '~/x.y']
)
def test_paths_are_written_as_they_are_read(path: str) -> None:
    """A path is the same when it is written again."""
    assert str(parse_path(f' {path} ')) == path


@pytest.mark.parametrize(
    ('text', 'sentence'),
    [
        ('', 'does not start with a topic name'),
        ('1a.b', 'does not start with a topic name'),
        ('a/1b.c', 'a letter or an underscore must follow each slash'),
        ('joint_states', 'names no message field'),
        ('joint_states[0]', 'names no message field'),
        ('joint_states.', "is not valid at '.': a field name must follow a dot"),
        ('joint_states.position[', "is not valid at '[': brackets must hold a number or a name"),
        ('joint_states.position[]', 'brackets must hold'),
        ('joint_states.position]', 'a dot or a bracket is expected'),
        ('joint_states.position 3', 'a dot or a bracket is expected'),
    ],
)
def test_broken_paths(text: str, sentence: str) -> None:
    """A broken path is refused with the place and an example."""
    with pytest.raises(PathError) as refused:
        parse_path(text)
    assert sentence in str(refused.value)
    assert 'A path is like joint_states.position[left_knee]' in str(refused.value)


@pytest.mark.parametrize(
    ('path', 'kind', 'message', 'number'),
    [
        ('js.position[knee]', 'a/State', state(hip=1.0, knee=2.0), 2.0),
        ('js.position[0]', 'a/State', state(hip=1.0, knee=2.0), 1.0),
        ('js.position[-1]', 'a/State', state(hip=1.0, knee=2.0), 2.0),
        ('js.header.stamp.sec', 'a/State', state(), 7.0),
        ('imu.turn.y', 'a/Imu', IMU, 2.5),
        ('imu.covariance[1]', 'a/Imu', IMU, 0.2),
        ('imu.is_on', 'a/Imu', IMU, 1.0),
        ('imu.raw', 'a/Imu', IMU, 7.0),
        ('tf.transforms[hand].at.x', 'a/Transforms', transforms(arm=1.0, hand=3.0), 3.0),
        ('tf.transforms[0].at.x', 'a/Transforms', transforms(arm=1.0), 1.0),
        ('plan.points[0].positions[knee]', 'a/Trajectory', TRAJECTORY, 0.75),
    ],
)
def test_reading(path: str, kind: str, message: Any, number: float) -> None:
    """Numbers are found by place, by names beside the list, and by names of elements."""
    assert read(path, kind, message) == number


@pytest.mark.parametrize(
    ('path', 'kind', 'sentence'),
    [
        ('js.positions', 'a/State', "js has no field 'positions', but header, name, position"),
        ('js.positions', 'a/State', "Did you mean 'position'?"),
        ('js.position', 'a/State', 'js.position is a list: add an index such as [0] or a name.'),
        ('imu.covariance', 'a/Imu', 'imu.covariance is a list: add an index such as [0].'),
        ('imu.covariance[x]', 'a/Imu', 'The elements of imu.covariance have no names'),
        ('js.header', 'a/State', 'js.header is not a number, but has the fields stamp, frame_id.'),
        ('js.header.frame_id', 'a/State', 'js.header.frame_id is not a number, but a string.'),
        ('js.header[0]', 'a/State', 'js.header is not a list, so it has no [0].'),
        ('js.position.x', 'a/State', 'It is a list: first add an index, such as [0].'),
        ('t.data', 'a/Text', 't.data is not a number, but a string<10>.'),
    ],
)
def test_paths_that_a_type_does_not_have(path: str, kind: str, sentence: str) -> None:
    """A path that no message of a type can have is refused before one has come."""
    with pytest.raises(PathError) as refused:
        FieldReader(parse_path(path), kind, schema)
    assert sentence in str(refused.value)


@pytest.mark.parametrize(
    ('path', 'message', 'sentence'),
    [
        (
            'js.position[kne]',
            state(hip=1.0, knee=2.0),
            "'kne', only hip, knee. Did you mean 'knee'",
        ),
        ('js.position[knee]', state(), "There is no element 'knee': the list is empty."),
        ('js.effort[knee]', state(knee=2.0), "'knee' is named, but the list has only 0."),
        ('js.position[2]', state(knee=2.0), 'There is no [2]: the list has 1.'),
    ],
)
def test_numbers_that_a_message_does_not_have(path: str, message: Any, sentence: str) -> None:
    """What only one message lacks is said with what it has."""
    with pytest.raises(PathError) as refused:
        read(path, 'a/State', message)
    assert sentence in str(refused.value)


def test_completions_of_a_type() -> None:
    """Without a message, lists show how their first place is written; texts are left out."""
    assert completions('a/State', schema) == [
        'header.stamp.sec',
        'header.stamp.nanosec',
        'position[0]',
        'effort[0]',
    ]
    assert completions('a/Text', schema) == []


@pytest.mark.parametrize(
    ('kind', 'message', 'paths'),
    [
        ('a/Imu', IMU, ['turn.x', 'turn.y', 'covariance[0]', 'covariance[1]', 'is_on', 'raw']),
        ('a/Transforms', transforms(arm=0.0), ['transforms[arm].at.x', 'transforms[arm].at.y']),
        (
            'a/Trajectory',
            TRAJECTORY,
            ['points[0].positions[0]', 'points[0].positions[1]'],
        ),
    ],
)
def test_completions_of_a_message(kind: str, message: Any, paths: list[str]) -> None:
    """A message tells the elements that there are, and what they are called."""
    assert completions(kind, schema, message) == paths


def test_completions_lead_to_numbers() -> None:
    """Whatever is offered can be read."""
    message = state(hip=1.0, knee=2.0)
    found = completions('a/State', schema, message)
    assert 'position[knee]' in found
    assert [read(f'js.{path}', 'a/State', message) for path in found] == [7.0, 8.0, 1.0, 2.0]


def test_completions_are_limited() -> None:
    """A huge list does not make a huge list to choose from."""
    huge = state(**{f'joint_{index}': 0.0 for index in range(10000)})
    assert len(completions('a/State', schema, huge)) <= 500


def test_series() -> None:
    """A series is a path, or the difference of two; a text lists several."""
    one, two = parse_all('a.x;  b.y - c.z ;')
    assert (str(one), str(two)) == ('a.x', 'b.y - c.z')
    assert (one.value([3.0]), two.value([3.0, 1.0])) == (3.0, 2.0)
    assert parse_all('') == []


@pytest.mark.parametrize(
    ('text', 'sentence'),
    [
        ('a.x - b.x - c.x', 'more than one minus'),
        ('; '.join(f'a.x[{index}]' for index in range(9)), '9 series are too many'),
    ],
)
def test_broken_series(text: str, sentence: str) -> None:
    """What cannot be plotted is refused with the reason."""
    with pytest.raises(PathError, match=sentence):
        parse_all(text)
    assert parse_series('a.x').paths
