# SPDX-License-Identifier: Apache-2.0
"""Clients that ask a server for transforms, over DDS."""

from __future__ import annotations

from collections.abc import Callable, Iterator
import signal
import subprocess
import threading
import time
from typing import Any

from geometry_msgs.msg import PointStamped
import pytest
from rclpy.action import ActionClient
from rclpy.action.client import ClientGoalHandle
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
import tf2_geometry_msgs  # noqa: F401 - registers the messages
from tf2_messages import at, numbers, stamped
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error
from tf2_ros import (
    Buffer,
    BufferClient,
    BufferServer,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
)

NodeMaker = Callable[..., Node]
LONG = Duration(seconds=60.0)
ENDLESS = Duration(seconds=3600.0)
SHORT = Duration(seconds=0.05)
NAME = 'transforms'


@pytest.fixture
def spinning(context: Any) -> Iterator[Callable[[Node], Node]]:
    """Return a function that lets a node work in a thread until the test ends."""
    threads: list[tuple[SingleThreadedExecutor, threading.Thread]] = []
    is_over = threading.Event()

    def work(executor: SingleThreadedExecutor) -> None:
        while not is_over.is_set():
            executor.spin_once(timeout_sec=0.1)

    def start(node: Node) -> Node:
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        thread = threading.Thread(target=work, args=(executor,))
        thread.start()
        threads.append((executor, thread))
        return node

    yield start
    is_over.set()
    for executor, thread in threads:
        thread.join()
        executor.shutdown()


@pytest.fixture
def buffer(make_node: NodeMaker, spinning: Callable[[Node], Node]) -> Buffer:
    """Return the buffer that a server offers."""
    buffer = Buffer()
    node = make_node('server')
    BufferServer(buffer, node, NAME)
    spinning(node)
    return buffer


@pytest.fixture
def client(make_node: NodeMaker, spinning: Callable[[Node], Node]) -> BufferClient:
    """Return a client of the server."""
    return BufferClient(spinning(make_node('client')), NAME, 50.0, timeout_padding=LONG)


def test_look_up(buffer: Buffer, client: BufferClient) -> None:
    """The client's answers are those of the server's buffer."""
    buffer.set_transform(stamped('map', 'odom', 1.0, (0, 0, 0)), 'test')
    buffer.set_transform(stamped('map', 'odom', 2.0, (2, 0, 0)), 'test')
    buffer.set_transform_static(stamped('odom', 'base', 0.0, (0, 3, 0)), 'test')
    for when in (at(1.5), at(1.5).to_msg(), at(0)):
        assert client.lookup_transform('map', 'base', when) == buffer.lookup_transform(
            'map', 'base', when
        )
    question = ('odom', at(2.0), 'odom', at(1.0), 'map')
    assert numbers(client.lookup_transform_full(*question))[0] == -2.0
    assert client.lookup_transform_full(*question) == buffer.lookup_transform_full(*question)


class SlowlyRead(dict[Any, Any]):
    """A dictionary in which it takes a while to find whether it has a key."""

    def __contains__(self, key: object) -> bool:
        """Return the answer late."""
        time.sleep(0.2)
        return super().__contains__(key)


def test_an_answer_comes_before_its_request_is_noted_down(
    buffer: Buffer, client: BufferClient
) -> None:
    """The thread that spins hands over no answer that nobody waits for yet."""
    buffer.set_transform_static(stamped('map', 'base', 0.0, (0, 3, 0)), 'test')
    for requests in ('_pending_goal_requests', '_pending_result_requests'):
        setattr(client.action_client, requests, SlowlyRead())
    assert client.can_transform('map', 'base', at(0)) is True


def test_can_transform(buffer: Buffer, client: BufferClient) -> None:
    """Whether a look-up succeeds is known without an exception."""
    buffer.set_transform(stamped('map', 'base', 1.0), 'test')
    assert client.can_transform('map', 'base', at(1.0)) is True
    assert client.can_transform('map', 'base', at(9.0)) is False
    assert client.can_transform_full('map', at(1.0), 'base', at(1.0), 'map') is True
    assert client.can_transform_full('map', at(1.0), 'base', at(9.0), 'map') is False


def test_transform(buffer: Buffer, client: BufferClient) -> None:
    """Messages are transformed as by a Buffer."""
    buffer.set_transform(stamped('map', 'base', 1.0, (1, 2, 3)), 'test')
    point = PointStamped()
    point.header.frame_id = 'base'
    moved = client.transform(point, 'map').point
    assert (moved.x, moved.y, moved.z) == (1.0, 2.0, 3.0)


@pytest.mark.parametrize(
    ('target', 'source', 'time_s', 'kind'),
    [
        ('map', 'nowhere', 0, LookupException),
        ('map', 'island', 0, ConnectivityException),
        ('map', 'base', 99, ExtrapolationException),
        ('', 'base', 0, InvalidArgumentException),
    ],
)
@pytest.mark.parametrize('timeout', [Duration(), SHORT])
def test_errors(
    buffer: Buffer,
    client: BufferClient,
    target: str,
    source: str,
    time_s: float,
    kind: type[Exception],
    timeout: Duration,
) -> None:
    """An exception of the server's buffer is the client's, with its text."""
    buffer.set_transform(stamped('map', 'base', 1.0), 'test')
    buffer.set_transform(stamped('sea', 'island', 1.0), 'test')
    with pytest.raises(kind) as here:
        buffer.lookup_transform(target, source, at(time_s))
    with pytest.raises(kind) as there:
        client.lookup_transform(target, source, at(time_s), timeout)
    assert str(there.value) == str(here.value)


def test_wait(buffer: Buffer, client: BufferClient) -> None:
    """The server answers as soon as it knows the transform, and others do not wait for that."""
    found: list[Any] = []
    asking = threading.Thread(
        target=lambda: found.append(client.lookup_transform('map', 'late', at(0), ENDLESS))
    )
    asking.start()
    buffer.set_transform(stamped('map', 'base', 1.0), 'test')
    assert client.can_transform('map', 'base', at(0), LONG)
    assert asking.is_alive()
    buffer.set_transform(stamped('map', 'late', 1.0, (5, 0, 0)), 'test')
    asking.join()
    assert numbers(found[0])[0] == 5.0


def test_no_server(make_node: NodeMaker, spinning: Callable[[Node], Node]) -> None:
    """Without a server there is a sentence about how to start one."""
    client = BufferClient(spinning(make_node('client')), 'nobody', 50.0, timeout_padding=SHORT)
    with pytest.raises(TimeoutException, match="offered the action 'nobody' for 0.05 s. Start"):
        client.lookup_transform('a', 'b', at(0))


def test_nobody_spins(buffer: Buffer, make_node: NodeMaker) -> None:
    """A client that no other thread spins says so instead of waiting for ever."""
    node = make_node('client')
    client = BufferClient(node, NAME, 50.0, timeout_padding=Duration(seconds=1.0))
    assert client.action_client.wait_for_server(30.0)
    with pytest.raises(TimeoutException, match='spin it in a thread other than'):
        client.lookup_transform('a', 'b', at(0))


def test_lost_responses(
    buffer: Buffer, client: BufferClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A goal and a request for its result are repeated until there is a response."""
    buffer.set_transform(stamped('a', 'b', 1.0, (7, 0, 0)), 'test')
    first = [Future()]
    send = client.action_client.send_goal_async

    def lossy_send(goal: LookupTransform.Goal) -> Future:
        return first.pop() if first else send(goal)

    first_result = [Future()]
    get_result = ClientGoalHandle.get_result_async

    def lossy_get(handle: ClientGoalHandle) -> Future:
        return first_result.pop() if first_result else get_result(handle)

    monkeypatch.setattr(client.action_client, 'send_goal_async', lossy_send)
    monkeypatch.setattr(ClientGoalHandle, 'get_result_async', lossy_get)
    assert numbers(client.lookup_transform('a', 'b', at(0)))[0] == 7.0
    assert not first and not first_result


def test_cancel(buffer: Buffer, make_node: NodeMaker, spin_until: Callable[..., None]) -> None:
    """A goal that waits can be cancelled."""
    node = make_node('canceller')
    client = ActionClient(node, LookupTransform, NAME)
    spin_until(client.server_is_ready, node)
    goal = LookupTransform.Goal(target_frame='a', source_frame='b', timeout=LONG.to_msg())
    sent = client.send_goal_async(goal)
    spin_until(sent.done, node)
    result = sent.result().get_result_async()
    cancelled = sent.result().cancel_goal_async()
    spin_until(result.done, node)
    assert cancelled.done() and result.result().status == 5
    assert result.result().result.error.error == TF2Error.NO_ERROR


@pytest.mark.parametrize(
    ('number', 'words', 'name'),
    [
        (signal.SIGINT, [], 'tf2_buffer_server'),
        (signal.SIGTERM, ['--ros-args', '-p', 'use_node_namespace:=true'], 'tf_buffer'),
    ],
)
def test_program(
    start_program: Callable[..., subprocess.Popen[str]],
    make_node: NodeMaker,
    spinning: Callable[[Node], Node],
    number: signal.Signals,
    words: list[str],
    name: str,
) -> None:
    """The program answers from what is published, and ends in order."""
    publisher = 'tf2_ros.static_transform_publisher'
    start_program(publisher, '--x', '4', '--frame-id', 'map', '--child-frame-id', 'odom')
    program = start_program('tf2_ros.buffer_server', *words)
    node = spinning(make_node('client'))
    client = BufferClient(node, name, timeout_padding=LONG)
    assert numbers(client.lookup_transform('map', 'odom', at(0), LONG))[0] == 4.0
    program.send_signal(number)
    _, errors = program.communicate(timeout=60.0)
    assert program.returncode == 0 and 'Traceback' not in errors


def test_program_arguments(start_program: Callable[..., subprocess.Popen[str]]) -> None:
    """Arguments that the program does not know are a sentence and status 1."""
    program = start_program('tf2_ros.buffer_server', '120')
    _, errors = program.communicate(timeout=60.0)
    assert program.returncode == 1
    assert errors.startswith("buffer_server takes no arguments, but got '120'.")
