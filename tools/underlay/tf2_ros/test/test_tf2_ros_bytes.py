# SPDX-License-Identifier: Apache-2.0
"""Transforms out of bytes are those that rclpy makes messages of."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Any

from geometry_msgs.msg import TransformStamped
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from tf2_msgs.msg import TFMessage
from tf2_py.messages import reading_of
from tf2_ros import Buffer, TransformListener
from tf2_ros.transform_listener import TfReader

NAMES = ['a', 'ab', 'abc', 'robot_1/left_arm', 'grüße', 'x' * 200, '', '/map']


def message_of(names: list[tuple[str, str]], random: Random) -> Any:
    """Return random transforms between frames."""
    message = TFMessage()
    for parent, child in names:
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec = random.randint(-5, 2**31 - 1)
        transform.header.stamp.nanosec = random.randint(0, 10**9 - 1)
        at, turn = transform.transform.translation, transform.transform.rotation
        at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w = (random.gauss(0, 9) for _ in range(7))
        message.transforms.append(transform)
    return message


def readings(data: bytes) -> list[Any]:
    """Return what rclpy reads."""
    return [reading_of(each) for each in deserialize_message(data, TFMessage).transforms]


@pytest.mark.parametrize('seed', range(20))
def test_same_as_messages(seed: int) -> None:
    """Whatever names and numbers there are, one reader reads them all as rclpy does."""
    random, reader = Random(seed), TfReader()
    for _ in range(20):
        count = random.choice([0, 1, 2, 7, 30])
        names = [(random.choice(NAMES), random.choice(NAMES)) for _ in range(count)]
        for _ in range(3):
            data = serialize_message(message_of(names, random))
            assert reader.read(data) == readings(data)


def test_robots_of_the_same_kind() -> None:
    """Messages that differ in names only are told apart, wherever these are."""
    random, reader = Random(1), TfReader()
    sets = [
        [('map', 'robot_1'), ('robot_1', 'arm_1')],
        [('map', 'robot_2'), ('robot_2', 'arm_2')],
        [('map', 'robot_1'), ('robot_1', 'arm_3')],
    ]
    for names in [*sets, *sets]:
        data = serialize_message(message_of(names, random))
        assert [each[:2] for each in reader.read(data)] == names


def test_big_endian() -> None:
    """Bytes of another order are read as well; a machine of that order may send them."""
    little = serialize_message(message_of([], Random(1)))
    assert TfReader().read(b'\x00\x00' + bytes(little[2:4]) + b'\x00' * 4) == []


@pytest.mark.parametrize('data', [b'', b'\x00', b'\x00\x01\x00\x00', b'\xff' * 50])
def test_broken_bytes(data: bytes) -> None:
    """Bytes that are no message come out as with rclpy, which is asked."""
    assert outcome(TfReader().read, data) == outcome(readings, data)


def outcome(read: Callable[[bytes], object], data: bytes) -> object:
    """Return what comes out, or the kind of the error."""
    try:
        return read(data)
    except Exception as error:
        return type(error)


def test_layouts_do_not_pile_up() -> None:
    """Names that change all the time cost no memory in the end."""
    reader = TfReader()
    for number in range(250):
        reader.read(serialize_message(message_of([('map', f'frame_{number}')], Random(1))))
    assert len(reader._layouts) <= 100


class Notes:
    """A node that remembers how it was asked to subscribe."""

    def __init__(self) -> None:
        self.is_raw: list[bool] = []

    def create_subscription(self, *arguments: Any, raw: bool, **options: Any) -> Any:
        self.is_raw.append(raw)
        return object()

    def get_clock(self) -> Any:
        return self

    def create_jump_callback(self, *arguments: Any, **options: Any) -> Any:
        return self

    def unregister(self) -> None:
        """End."""


class Seeing(Buffer):
    """A buffer that wants to see messages."""

    def set_transform(self, transform: Any, authority: str) -> None:
        """See one."""


class SeeingListener(TransformListener):
    """A listener that wants to see messages."""

    def callback(self, data: Any) -> None:
        """See one."""


@pytest.mark.parametrize(
    ('listener', 'buffer', 'is_raw'),
    [
        (TransformListener, Buffer, True),
        (TransformListener, Seeing, False),
        (SeeingListener, Buffer, False),
    ],
)
def test_who_wants_messages_gets_them(listener: Any, buffer: Any, is_raw: bool) -> None:
    """Messages are only left out if neither the listener nor the buffer has methods for them."""
    node = Notes()
    listener(buffer(), node)
    assert node.is_raw == [is_raw, is_raw]
