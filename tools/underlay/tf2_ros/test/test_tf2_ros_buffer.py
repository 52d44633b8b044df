# SPDX-License-Identifier: Apache-2.0
"""A buffer that waits and transforms, without nodes."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field
import threading
import time
from typing import Any

import pytest
from rclpy.duration import Duration
from std_msgs.msg import Header
from tf2_messages import at, numbers, stamped
import tf2_ros
from tf2_ros import (
    Buffer,
    convert,
    ExtrapolationException,
    LookupException,
    TransformRegistration,
    TypeException,
)

LONG = Duration(seconds=20.0)
SHORT = Duration(seconds=0.05)


@pytest.fixture
def buffer() -> Buffer:
    """Return a buffer with a frame that does not move."""
    buffer = Buffer()
    buffer.set_transform_static(stamped('map', 'odom', 0.0, (1, 2, 3)), 'test')
    return buffer


@dataclass
class Marker:
    """Something that can be moved."""

    header: Header = field(default_factory=Header)
    x: float = 0.0


def later(action: Any) -> None:
    """Do something in a moment, in another thread."""
    threading.Timer(0.1, action).start()


def test_all_names_are_there() -> None:
    """What the package promises can be imported."""
    for name in tf2_ros.__all__:
        assert getattr(tf2_ros, name) is not None
    assert tf2_ros.buffer.Buffer is Buffer
    with pytest.raises(AttributeError, match="Did you mean: 'TransformListener'"):
        _ = tf2_ros.TransformListner


def test_wait_for_a_transform(buffer: Buffer) -> None:
    """A look-up with a timeout gets a transform that comes meanwhile."""
    later(lambda: buffer.set_transform(stamped('odom', 'base', 5.0, (1, 0, 0)), 'test'))
    result = buffer.lookup_transform('map', 'base', at(5.0), LONG)
    assert numbers(result)[:3] == [2, 2, 3]


def test_wait_for_a_full_transform(buffer: Buffer) -> None:
    """The full forms wait as well."""
    arguments = ('base', at(6.0), 'base', at(5.0), 'map')
    assert not buffer.can_transform_full(*arguments)
    for time_s in (5.0, 6.0):
        message = stamped('odom', 'base', time_s, (time_s, 0, 0))
        later(lambda message=message: buffer.set_transform(message, 'test'))
    assert buffer.can_transform_full(*arguments, timeout=LONG)
    assert numbers(buffer.lookup_transform_full(*arguments, LONG))[:3] == [-1, 0, 0]


def test_end_of_the_wait(buffer: Buffer) -> None:
    """After the timeout the look-up fails, with the reason."""
    begin_s = time.monotonic()
    with pytest.raises(LookupException, match='"base" passed to lookupTransform'):
        buffer.lookup_transform('map', 'base', at(0), SHORT)
    assert time.monotonic() - begin_s >= 0.05
    assert buffer.can_transform('map', 'base', at(0), SHORT) is False
    found, text = buffer.can_transform('map', 'base', at(0), SHORT, return_debug_tuple=True)
    assert not found and 'frame does not exist' in text
    assert buffer.can_transform('map', 'odom', at(0), return_debug_tuple=True) == (True, '')


def test_advice_after_a_wait(buffer: Buffer) -> None:
    """Who has waited is not asked to pass a timeout."""
    buffer.set_transform(stamped('map', 'base', 10.0), 'test')
    buffer.set_transform(stamped('map', 'base', 11.0), 'test')
    text = 'not received within 0.05 s; wait longer, or ask for time 0'
    found, reason = buffer.can_transform('map', 'base', at(11.5), SHORT, return_debug_tuple=True)
    assert not found and text in reason
    with pytest.raises(ExtrapolationException) as caught:
        buffer.lookup_transform('map', 'base', at(11.5), SHORT)
    assert text in str(caught.value) and 'pass a timeout' not in str(caught.value)


def test_wait_in_the_thread_that_receives(buffer: Buffer) -> None:
    """A wait that nothing can end is explained."""
    with pytest.raises(LookupException, match='TransformListener with spin_thread=True'):
        buffer.lookup_transform('map', 'base', at(0), SHORT)
    with pytest.raises(LookupException) as caught:
        buffer.lookup_transform('map', 'base', at(0))
    assert 'spin_thread' not in str(caught.value)


def test_futures(buffer: Buffer) -> None:
    """A future is done as soon as there is a transform."""
    assert buffer.wait_for_transform_async('map', 'odom', at(0)).result() is True
    future = buffer.wait_for_transform_async('map', 'base', at(0))
    full = buffer.wait_for_transform_full_async('map', at(0), 'base', at(5), 'odom')
    cancelled = buffer.wait_for_transform_async('map', 'base', at(0))
    cancelled.cancel()
    assert not future.done() and not full.done()
    buffer.set_transform(stamped('odom', 'base', 5.0), 'test')
    assert future.result() is True and full.result() is True and cancelled.result() is None


def test_waiting_for_unknown_frames_is_cheap(
    buffer: Buffer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is missing is explained to who asks, not at each transform that comes meanwhile."""
    explained: list[Any] = []
    monkeypatch.setattr(
        'tf2_py._frame_store.unknown_frame', lambda *call: explained.append(call) or 'unknown'
    )
    future = buffer.wait_for_transform_async('map', 'hand', at(0))
    later(lambda: buffer.set_transform(stamped('odom', 'base', 5.0), 'test'))
    assert buffer.can_transform('map', 'base', at(0), LONG)
    assert not explained and not future.done()
    found = buffer.can_transform('map', 'hand', at(0), SHORT, return_debug_tuple=True)
    assert found == (False, 'unknown') and len(explained) == 1


def test_futures_are_not_kept(buffer: Buffer) -> None:
    """What is done or cancelled is forgotten, and nothing gets a result twice."""
    done = buffer.wait_for_transform_async('map', 'base', at(0))
    cancelled = buffer.wait_for_transform_async('map', 'hand', at(0))
    cancelled.cancel()
    results: list[bool] = []
    done.set_result = results.append
    for time_s in (5.0, 6.0):
        buffer.set_transform(stamped('odom', 'base', time_s), 'test')
    assert results == [True]
    assert not buffer._waiting._futures


def test_coroutines(buffer: Buffer) -> None:
    """The asynchronous look-ups return the transforms."""
    assert numbers(asyncio.run(buffer.lookup_transform_async('map', 'odom', at(0))))[2] == 3
    full = buffer.lookup_transform_full_async('map', at(0), 'odom', at(0), 'map')
    assert numbers(asyncio.run(full))[2] == 3


def test_transform(buffer: Buffer) -> None:
    """An object is transformed by what is registered for its type, to any time."""

    def move(marker: Marker, transform: Any) -> Marker:
        return Marker(transform.header, marker.x + transform.transform.translation.x)

    marker = Marker(Header(frame_id='odom'), 5.0)
    with pytest.raises(TypeException, match=r"Marker'> is not loaded .* 'import tf2_geometry_ms"):
        buffer.transform(marker, 'map')
    TransformRegistration().add(Marker, move)
    assert buffer.transform(marker, 'map').x == 6.0
    assert buffer.transform(marker, 'map').header.frame_id == 'map'
    assert buffer.transform_full(marker, 'map', at(3), 'map').x == 6.0
    tf2_ros.ConvertRegistration().add_convert((Marker, float), lambda marker: marker.x)
    assert buffer.transform(marker, 'map', new_type=float) == 6.0


def test_convert() -> None:
    """Objects are converted directly, or through a message; the same type is copied."""
    registration = tf2_ros.ConvertRegistration()
    registration.add_to_msg(Marker, lambda marker: marker.x)
    registration.add_from_msg(complex, complex)
    assert convert(Marker(x=2.0), complex) == 2 + 0j
    marker = Marker()
    assert convert(marker, Marker) == marker and convert(marker, Marker) is not marker
    with pytest.raises(TypeException, match='conversions from messages loaded are for: .*complex'):
        convert(Marker(), bytes)


def test_interface() -> None:
    """The interface itself has no transforms."""
    interface = tf2_ros.BufferInterface()
    calls = [
        lambda: interface.lookup_transform('a', 'b', at(0)),
        lambda: interface.can_transform('a', 'b', at(0)),
        lambda: interface.lookup_transform_full('a', at(0), 'b', at(0), 'c'),
        lambda: interface.can_transform_full('a', at(0), 'b', at(0), 'c'),
    ]
    for call in calls:
        with pytest.raises(tf2_ros.NotImplementedException, match='implemented by a subclass'):
            call()


def test_stamped() -> None:
    """An object gets a header."""
    marker = tf2_ros.Stamped(Marker(), at(1.5).to_msg(), 'map')
    assert marker.header.frame_id == 'map' and marker.header.stamp.nanosec == 500_000_000
