# SPDX-License-Identifier: Apache-2.0
"""Poses between frames and their parents; transforms are taken when a frame is drawn."""

from __future__ import annotations

from collections.abc import Iterator
import math
import os
import time
from typing import Any

from domain_coordinator import domain_id
from geometry_msgs.msg import TransformStamped
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rviz_common.frames import FIXED_FRAME, FrameError, FrameListener, Frames, Pose
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster

HALF = math.sqrt(0.5)

TIMEOUT_S = 60.0


@pytest.fixture
def frames() -> Frames:
    """Return frames of a robot that stands in a map: one that turns, and one that does not."""
    buffer = Buffer()
    for parent, child, x in (('map', 'base', 1.0), ('base', 'arm', 2.0), ('x', 'y', 3.0)):
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec = 5
        transform.transform.translation.x = x
        transform.transform.rotation.z = transform.transform.rotation.w = HALF
        buffer.set_transform(transform, 'test')
    return Frames(buffer, 'map')


def test_down_and_up(frames: Frames) -> None:
    """A frame in its parent is what was said; the parent in the frame is the opposite."""
    assert frames.find('map', 'base') == Pose((1.0, 0.0, 0.0), pytest.approx((HALF, 0, 0, HALF)))
    up = frames.find('base', 'map')
    assert up is not None
    assert up.position == pytest.approx((0.0, 1.0, 0.0))
    assert up.wxyz == pytest.approx((HALF, 0.0, 0.0, -HALF))


@pytest.mark.parametrize('stamp_ns', [0, 5 * 10**9])
def test_short_cut_is_no_other_way(frames: Frames, stamp_ns: int) -> None:
    """With a time or without one, the same comes out."""
    for target, source in (('map', 'base'), ('base', 'map'), ('map', 'arm')):
        found, latest = frames.between(target, source, stamp_ns), frames.find(target, source)
        assert latest is not None
        assert found.position == pytest.approx(latest.position)
        assert found.wxyz == pytest.approx(latest.wxyz)


def test_several_hops(frames: Frames) -> None:
    """Frames that are not next to each other are found as well."""
    assert frames.find(FIXED_FRAME, 'arm').position == pytest.approx((1.0, 2.0, 0.0))
    assert frames.find('arm', 'arm') == Pose()


@pytest.mark.parametrize('source', ['nobody', 'y', ''])
def test_nowhere(frames: Frames, source: str) -> None:
    """What is not known is None, and the reason can be asked for."""
    assert frames.find('map', source) is None
    assert frames.reason('map', source).startswith(f'No transform from [{source}] to [map]: ')
    with pytest.raises(FrameError):
        frames.between('map', source)


def test_no_reason(frames: Frames) -> None:
    """There is no reason for what is known."""
    assert frames.reason('map', 'arm') == ''


def test_latest(frames: Frames) -> None:
    """All frames with a parent can be had at once."""
    assert {name: sample.parent for name, sample in frames.latest().items()} == {
        'base': 'map',
        'arm': 'base',
        'y': 'x',
    }


@pytest.fixture
def context(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Return ROS in a domain of its own."""
    monkeypatch.setitem(os.environ, 'ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    with domain_id() as domain:
        context = rclpy.Context()
        context.init(domain_id=domain)
        yield context
        context.try_shutdown()


def transform(child: str, stamp_s: int) -> TransformStamped:
    """Return where a frame is in the map."""
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = 'map'
    message.header.stamp.sec = stamp_s
    message.transform.rotation.w = 1.0
    return message


def test_transforms_wait_for_the_frame(context: Any) -> None:
    """An executor does not take transforms; all that have come are taken at once."""
    robot = rclpy.create_node('robot', context=context)
    user = rclpy.create_node('user', context=context)
    buffer = Buffer()
    listener = FrameListener(buffer, user)
    moving, static = TransformBroadcaster(robot), StaticTransformBroadcaster(robot)
    static.sendTransform(transform('camera', 0))
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(user)
    end_s = time.monotonic() + TIMEOUT_S
    while robot.count_subscribers('/tf') == 0:
        assert time.monotonic() < end_s, 'nobody listens'
        executor.spin_once(timeout_sec=0.05)
    stamps_s = list(range(1, 6))
    for stamp_s in stamps_s:
        moving.sendTransform(transform('base', stamp_s))
    for _ in range(5):
        executor.spin_once(timeout_sec=0.05)
    assert buffer.known_frames.latest_of_all() == {}
    while (
        len(taken := buffer.known_frames.latest_of_all()) < 2 or taken['base'].stamp_ns < 5 * 10**9
    ):
        assert time.monotonic() < end_s, f'only these came: {taken}'
        moving.sendTransform(transform('base', 5))
        listener.take_all()
        time.sleep(0.05)
    assert taken['camera'].stamp_ns == 0
    listener.unregister()
    executor.shutdown()
    user.destroy_node()
    robot.destroy_node()


def test_moving_transforms_only_while_it_does_not_rest(context: Any) -> None:
    """A listener that rests hears static transforms only, and all of them when it resumes."""
    robot = rclpy.create_node('robot', context=context)
    user = rclpy.create_node('user', context=context)
    buffer = Buffer()
    listener = FrameListener(buffer, user)
    listener.rest()
    moving, static = TransformBroadcaster(robot), StaticTransformBroadcaster(robot)
    static.sendTransform(transform('camera', 0))
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(user)

    def known_after(wanted: str) -> set[str]:
        end_s = time.monotonic() + TIMEOUT_S
        while wanted not in (known := set(buffer.known_frames.latest_of_all())):
            assert time.monotonic() < end_s, f'only these came: {known}'
            moving.sendTransform(transform('base', 5))
            executor.spin_once(timeout_sec=0.05)
            listener.take_all()
        return known

    assert known_after('camera') == {'camera'}
    assert robot.count_subscribers('/tf') == 0
    listener.resume()
    assert known_after('base') == {'camera', 'base'}
    listener.rest()
    listener.unregister()
    assert list(user.subscriptions) == []
    executor.shutdown()
    user.destroy_node()
    robot.destroy_node()
