# SPDX-License-Identifier: Apache-2.0
"""Transforms are taken when a frame is drawn."""

from __future__ import annotations

from collections.abc import Iterator
import os
import time
from typing import Any

from domain_coordinator import domain_id
from geometry_msgs.msg import TransformStamped
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rviz_common.frame_listener import FrameListener
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster

TIMEOUT_S = 60.0


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
    assert buffer._latest_samples() == {}
    while len(taken := buffer._latest_samples()) < 2 or taken['base'].stamp_ns < 5 * 10**9:
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
        while wanted not in (known := set(buffer._latest_samples())):
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
