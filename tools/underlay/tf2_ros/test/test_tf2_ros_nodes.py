# SPDX-License-Identifier: Apache-2.0
"""Listeners and broadcasters in nodes."""

from __future__ import annotations

from collections.abc import Callable
import gc
import threading
from typing import Any
from weakref import ref

import pytest
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from tf2_messages import at, numbers, stamped
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph
from tf2_ros import (
    Buffer,
    BufferCore,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformListener,
)

LONG = Duration(seconds=20.0)
NodeMaker = Callable[..., Node]
Spin = Callable[..., None]


def test_transforms_arrive(make_node: NodeMaker, spin_until: Spin) -> None:
    """What is broadcast is in the buffer; what is static also for those who come later."""
    robot, user = make_node('robot'), make_node('user')
    static = StaticTransformBroadcaster(robot)
    static.sendTransform(stamped('base', 'camera', 0.0, (0, 0, 1)))
    static.sendTransform([stamped('base', 'lidar'), stamped('base', 'camera', 0.0, (0, 0, 2))])
    moving = TransformBroadcaster(robot)
    buffer = Buffer()
    TransformListener(buffer, user)

    def arrived() -> bool:
        moving.sendTransform([stamped('map', 'odom', 5.0), stamped('odom', 'base', 5.0)])
        return bool(buffer.can_transform('map', 'camera', at(5.0)))

    spin_until(arrived, robot, user)
    spin_until(lambda: buffer.can_transform('base', 'lidar', at(0)), user)
    assert numbers(buffer.lookup_transform('map', 'camera', at(5.0)))[2] == 2


def test_one_message_holds_all_static_transforms(make_node: NodeMaker, spin_until: Spin) -> None:
    """A static broadcaster repeats what it has said, with the last word on each frame."""
    received: list[Any] = []
    node = make_node('robot')
    static = StaticTransformBroadcaster(node)
    node.create_subscription(TFMessage, '/tf_static', received.append, 1)
    static.sendTransform(stamped('base', 'camera'))
    static.sendTransform(stamped('arm', 'camera'))
    static.sendTransform(stamped('base', 'lidar'))
    spin_until(lambda: received and len(received[-1].transforms) == 2, node)
    parents = {item.child_frame_id: item.header.frame_id for item in received[-1].transforms}
    assert parents == {'camera': 'arm', 'lidar': 'base'}


def test_static_broadcaster_keeps_what_it_was_given(
    make_node: NodeMaker, spin_until: Spin
) -> None:
    """Who fills the same message for each frame loses none of them."""
    received: list[Any] = []
    node = make_node('robot')
    static, message = StaticTransformBroadcaster(node), stamped('base', 'camera')
    node.create_subscription(TFMessage, '/tf_static', received.append, 1)
    static.sendTransform(message)
    message.child_frame_id = 'lidar'
    static.sendTransform(message)
    spin_until(lambda: received and len(received[-1].transforms) == 2, node)
    names = [item.child_frame_id for item in received[-1].transforms]
    assert names == ['camera', 'lidar']


def test_qos(make_node: NodeMaker, spin_until: Spin) -> None:
    """The topics are reliable; only the static one is for late comers."""
    node = make_node('qos_robot')
    TransformBroadcaster(node)
    StaticTransformBroadcaster(node)
    TransformListener(BufferCore(), node)
    spin_until(lambda: node.count_publishers('/tf') and node.count_subscribers('/tf_static'), node)
    for topic, durability in (
        ('/tf', DurabilityPolicy.VOLATILE),
        ('/tf_static', DurabilityPolicy.TRANSIENT_LOCAL),
    ):
        infos = node.get_publishers_info_by_topic(topic) + node.get_subscriptions_info_by_topic(
            topic
        )
        own = [info for info in infos if info.node_name == 'qos_robot']
        assert len(own) == 2
        for info in own:
            assert info.qos_profile.durability == durability
            assert info.qos_profile.reliability == ReliabilityPolicy.RELIABLE


def test_listener_thread(make_node: NodeMaker) -> None:
    """With a thread of its own, look-ups may wait; it ends with the listener."""
    robot, user = make_node('robot'), make_node('user')
    StaticTransformBroadcaster(robot).sendTransform(stamped('base', 'camera', 0.0, (0, 0, 4)))
    buffer = Buffer()
    listener = TransformListener(buffer, user, spin_thread=True)
    assert numbers(buffer.lookup_transform('base', 'camera', at(0), LONG))[2] == 4
    listener.unregister()
    assert 'transform listener' not in {thread.name for thread in threading.enumerate()}
    topics = {subscription.topic_name for subscription in user.subscriptions}
    assert not topics & {'/tf', '/tf_static'}


def test_lookups_while_transforms_arrive(make_node: NodeMaker) -> None:
    """Look-ups beside the listener's thread see the transforms of a message as they belong."""
    robot, user = make_node('robot'), make_node('user')
    broadcaster, buffer = TransformBroadcaster(robot), Buffer()
    listener = TransformListener(buffer, user, spin_thread=True)
    count = 0
    for number in range(1, 2000):
        time_s = number / 100
        there = stamped('map', 'odom', time_s, (time_s, 0, 0))
        back = stamped('odom', 'base', time_s, (-time_s, 0, 0))
        broadcaster.sendTransform([there, back])
        if buffer.can_transform('map', 'base', at(0)):
            assert abs(numbers(buffer.lookup_transform('map', 'base', at(0)))[0]) < 1e-9
            count += 1
    listener.unregister()
    assert count > 10


def test_await_in_a_callback(make_node: NodeMaker, spin_until: Spin) -> None:
    """A callback may await a transform that the same executor receives."""
    robot, user = make_node('robot'), make_node('user')
    static, buffer = StaticTransformBroadcaster(robot), Buffer()
    TransformListener(buffer, user)
    results: list[Any] = []

    async def look() -> None:
        timer.cancel()
        results.append(await buffer.lookup_transform_async('awaited', 'camera', at(0)))

    def awaited() -> bool:
        if timer.is_canceled():
            static.sendTransform(stamped('awaited', 'camera', 0.0, (0, 0, 4)))
        return bool(results)

    timer = user.create_timer(0.01, look)
    spin_until(awaited, user)
    assert numbers(results[0])[2] == 4


def test_await_what_another_thread_brings(make_node: NodeMaker) -> None:
    """A callback that awaits a transform goes on when another thread fills the buffer."""
    node, results = make_node('user'), threading.Event()
    buffer = Buffer(node=node)
    waits = threading.Event()

    async def look() -> None:
        timer.cancel()
        waits.set()
        await buffer.lookup_transform_async('awaited', 'camera', at(0))
        results.set()

    timer = node.create_timer(0.01, look)
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    is_over = threading.Event()

    def work() -> None:
        while not is_over.is_set():
            executor.spin_once(timeout_sec=0.1)

    thread = threading.Thread(target=work)
    thread.start()
    try:
        assert waits.wait(100)
        assert not results.wait(0.2)
        buffer.set_transform_static(stamped('awaited', 'camera'), 'test')
        assert results.wait(100)
    finally:
        is_over.set()
        thread.join()
        executor.shutdown()


def test_static_only(make_node: NodeMaker) -> None:
    """A listener may leave out what moves."""
    node = make_node('user')
    listener = TransformListener(BufferCore(), node, static_only=True)
    topics = {subscription.topic_name for subscription in node.subscriptions}
    assert '/tf_static' in topics and '/tf' not in topics
    listener.unregister()
    assert '/tf_static' not in {subscription.topic_name for subscription in node.subscriptions}


def test_time_jumps_back(
    make_node: NodeMaker, spin_until: Spin, capfd: pytest.CaptureFixture[str]
) -> None:
    """When simulated time begins anew, what moves is forgotten; that it does so is said once."""
    node = make_node(
        'user', parameter_overrides=[Parameter('use_sim_time', Parameter.Type.BOOL, True)]
    )
    clock = node.create_publisher(Clock, '/clock', 1)
    buffer = Buffer(node=node)
    TransformListener(buffer, node)

    def time_is(time_s: float) -> Callable[[], bool]:
        def check() -> bool:
            clock.publish(Clock(clock=at(time_s).to_msg()))
            return bool(node.get_clock().now().nanoseconds == at(time_s).nanoseconds)

        return check

    spin_until(time_is(50.0), node)
    buffer.set_transform_static(stamped('base', 'camera'), 'test')
    buffer.set_transform(stamped('map', 'base', 50.0), 'test')
    spin_until(time_is(51.0), node)
    assert buffer.can_transform('map', 'camera', at(50.0))
    spin_until(time_is(2.0), node)
    assert not buffer.can_transform('map', 'base', at(0))
    assert buffer.can_transform('base', 'camera', at(0))
    buffer.set_transform(stamped('map', 'base', 2.0), 'test')
    assert buffer.can_transform('map', 'camera', at(2.0))
    for time_s in (40.0, 3.0, 40.0, 3.0):  # as with two simulators
        spin_until(time_is(time_s), node)
    assert not buffer.can_transform('map', 'camera', at(2.0))
    assert capfd.readouterr().err.count('jump back in time') == 1


def test_many_buffers_one_after_the_other(make_node: NodeMaker) -> None:
    """A node may listen now and then: nothing of a buffer is left in its clock."""
    node = make_node('user')
    buffers = []
    for _ in range(300):
        buffer = Buffer()
        TransformListener(buffer, node).unregister()
        buffers.append(ref(buffer))
        del buffer
    gc.collect()
    assert not any(each() for each in buffers)


def test_service(make_node: NodeMaker, spin_until: Spin) -> None:
    """A buffer with a node tells its frames to others."""
    node, other = make_node('robot'), make_node('other')
    buffer = Buffer(node=node)
    buffer.set_transform_static(stamped('base', 'camera'), 'test')
    client = other.create_client(FrameGraph, 'tf2_frames')
    spin_until(client.service_is_ready, node, other)
    future = client.call_async(FrameGraph.Request())
    spin_until(future.done, node, other)
    assert "parent: 'base'" in future.result().frame_yaml


def test_wait_ends_with_the_context(make_node: NodeMaker) -> None:
    """A look-up does not outlive the node's context by its timeout."""
    node = make_node('user')
    buffer = Buffer()
    TransformListener(buffer, node)
    threading.Timer(0.2, node.context.try_shutdown).start()
    assert not buffer.can_transform('a', 'b', at(0), Duration(seconds=300.0))


def test_remapping(context: Any, spin_until: Spin) -> None:
    """Two robots in namespaces have transforms of their own when /tf is remapped to tf."""
    remap = ['--ros-args', '-r', '/tf:=tf', '-r', '/tf_static:=tf_static']
    nodes = {
        name: Node('robot', namespace=name, context=context, cli_args=remap)
        for name in ('one', 'two')
    }
    buffers = {name: Buffer() for name in nodes}
    for number, (name, node) in enumerate(nodes.items()):
        TransformListener(buffers[name], node)
        StaticTransformBroadcaster(node).sendTransform(stamped('a', 'b', 0.0, (number, 0, 0)))
    for number, name in enumerate(nodes):
        spin_until(lambda name=name: buffers[name].can_transform('a', 'b', at(0)), *nodes.values())
        assert numbers(buffers[name].lookup_transform('a', 'b', at(0)))[0] == number
