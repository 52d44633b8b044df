# SPDX-License-Identifier: Apache-2.0
"""Tests of messages that are filled from plain values."""

from typing import Any

from builtin_interfaces.msg import Time
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PoseStamped, PoseWithCovariance
import pytest
from ros2cli.messages.lookup import get_passed_type
from ros2cli.messages.outgoing import fill, OutgoingMessage
from ros2cli.messages.values import parse_values
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, ByteMultiArray, String, UInt64


def outgoing(type_name: str, text: str) -> OutgoingMessage:
    """Return a message as `ros2 topic pub` makes it."""
    return OutgoingMessage(get_passed_type(type_name, 'msg')(), text)


def test_nested_fields_are_set() -> None:
    """Mappings reach into nested messages; what is not named keeps its default."""
    message = PoseStamped()
    fill(message, {'pose': {'position': {'x': 1, 'z': -2.5}}})
    position = message.pose.position
    assert (position.x, position.y, position.z) == (1.0, 0.0, -2.5)
    assert message.pose.orientation.w == 1.0


def test_values_are_cast_to_the_type_of_the_field() -> None:
    """Numbers become texts and floats where the field needs them."""
    text, flag, joints = String(), Bool(), JointState()
    fill(text, {'data': 1})
    fill(flag, {'data': True})
    fill(joints, {'name': [1, 'b'], 'position': [1, 2]})
    assert (text.data, flag.data) == ('1', True)
    assert (joints.name, list(joints.position)) == (['1', 'b'], [1.0, 2.0])


@pytest.mark.parametrize('value', ['maybe', 'flase', 'true', '', 1, 0.0, [True]])
def test_booleans_are_those_of_yaml(value: Any) -> None:
    """Anything else is truthy in Python, a typing mistake in an emergency stop as well."""
    message = Bool()
    with pytest.raises(ValueError, match="'data' needs true or false, but got"):
        fill(message, {'data': value})
    assert message.data is False


def test_integers_are_exact() -> None:
    """The largest number of the largest type is not rounded."""
    message = UInt64()
    fill(message, {'data': 2**64 - 1})
    assert message.data == 2**64 - 1


def test_arrays_of_all_kinds() -> None:
    """Arrays of fixed size, of bytes and of messages are filled."""
    pose, octets, status = PoseWithCovariance(), ByteMultiArray(), DiagnosticStatus()
    fill(pose, {'covariance': list(range(36))})
    fill(octets, {'data': [65, 255]})
    fill(status, {'values': [{'key': 'a', 'value': 1}]})
    assert list(pose.covariance) == [float(number) for number in range(36)]
    assert octets.data == [b'A', b'\xff']
    assert (status.values[0].key, status.values[0].value) == ('a', '1')


def test_time_is_set_at_each_publication() -> None:
    """A header with the value `auto` gets the present time whenever it is published."""
    message = outgoing('geometry_msgs/msg/PoseStamped', '{header: auto}')
    for second in (3, 4):
        assert message.stamped(Time(sec=second)).header.stamp.sec == second


def test_now_is_a_time() -> None:
    """A field of the type Time takes the value `now`."""
    message = outgoing('std_msgs/Header', '{stamp: now}')
    assert message.stamped(Time(sec=5)).stamp.sec == 5


@pytest.mark.parametrize(
    ('type_name', 'text', 'error'),
    [
        (
            'std_msgs/msg/String',
            '{nope: 1}',
            "Failed to populate field: 'String' object has no attribute 'nope'",
        ),
        (
            'std_msgs/msg/UInt8',
            '{data: x}',
            r"Failed to populate field: 'data' needs a whole number from 0 to 255 \(uint8\), "
            "but got 'x'",
        ),
        ('std_msgs/msg/UInt8', '{data: 300}', r'from 0 to 255 \(uint8\), but got 300'),
        ('std_msgs/msg/Int8', '{data: 1.5}', r'from -128 to 127 \(int8\), but got 1.5'),
        ('std_msgs/msg/Int8', '{data: .inf}', r'from -128 to 127 \(int8\), but got inf'),
        ('std_msgs/msg/Float32', '{data: x}', "'data' needs a number, but got 'x'"),
        ('std_msgs/msg/Byte', '{data: 256}', r'from 0 to 255 \(byte\), but got 256'),
        ('std_msgs/msg/Bool', '{data: [1]}', r"'data' needs true or false, but got \[1\]"),
        ('std_msgs/msg/String', '{data: {a: 1}}', "'data' needs a string, but got {'a': 1}"),
        (
            'sensor_msgs/msg/JointState',
            '{name: a}',
            "Failed to populate field: 'name' needs a list",
        ),
        (
            'sensor_msgs/msg/Imu',
            '{orientation_covariance: [1]}',
            "'orientation_covariance' needs 9 elements, but got 1",
        ),
        ('sensor_msgs/msg/JointState', '{header: 1}', "'header' needs a mapping"),
        ('std_msgs/msg/String', '[1]', 'The passed value needs to be a dictionary in YAML format'),
        ('std_msgs/msg/String', '{a: [', 'The passed value is not valid YAML'),
        ('std_msgs/msg/Strin', '{}', 'The passed message type is invalid'),
    ],
)
def test_wrong_values_are_explained(type_name: str, text: str, error: str) -> None:
    """Each kind of mistake has its text."""
    with pytest.raises(RuntimeError, match=error):
        outgoing(type_name, text)


@pytest.mark.parametrize(
    ('text', 'values'), [('', {}), ('data: hi', {'data': 'hi'}), ('{x: [1, 2]}', {'x': [1, 2]})]
)
def test_yaml_becomes_a_mapping(text: str, values: dict[str, Any]) -> None:
    """Block and flow style are understood; nothing means the defaults."""
    assert parse_values(text) == values
