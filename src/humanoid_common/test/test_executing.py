# SPDX-License-Identifier: Apache-2.0
"""Check that all that nodes do works with the executor that they use."""

from __future__ import annotations

from collections.abc import Iterator
import gc
import subprocess
import sys
import threading
from typing import Any

from humanoid_common.executing import create_async_service, destroy, make_executor, spin_until
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
import pytest
from rcl_interfaces.msg import Log, ParameterEvent
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future
from rosgraph_msgs.msg import Clock as ClockMessage
from std_msgs.msg import Float64
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform

FAILING_TASK = """
import rclpy
from humanoid_common.executing import make_executor, spin_until
def fail():
    raise LookupError('a mistake')
rclpy.init()
node = rclpy.create_node('failing')
executor = make_executor()
executor.add_node(node)
executor.create_task(fail)
spin_until(executor, rclpy.task.Future())
"""


@pytest.fixture
def ros() -> Iterator[RosSandbox]:
    """Give nodes in this process."""
    with ros_sandbox() as sandbox:
        yield sandbox


def steady() -> Clock:
    """Make a clock that nobody sets."""
    return Clock(clock_type=ClockType.STEADY_TIME)


def tell(publisher: Any, time_s: int) -> None:
    """Publish a time."""
    message = ClockMessage()
    message.clock.sec = time_s
    publisher.publish(message)


def test_timers_in_simulated_time(ros: RosSandbox) -> None:
    """Timers of a node follow /clock, stand still with it, and go on after it has jumped back."""
    node = ros.start(lambda **more: Node('timed', **more), {'use_sim_time': True})
    clock = ros.observer().create_publisher(ClockMessage, '/clock', 10)
    ticks: list[float] = []
    looks: list[None] = []
    node.create_timer(1.0, lambda: ticks.append(node.get_clock().now().nanoseconds / 1e9))
    node.create_timer(0.01, lambda: looks.append(None), clock=steady())
    ros.wait_until(lambda: clock.get_subscription_count() > 0)
    ros.wait_until(lambda: len(looks) > 10)
    assert not ticks
    for time_s in (10, 11, 12, 3, 4, 5):
        tell(clock, time_s)
        ros.wait_until(lambda: node.get_clock().now().nanoseconds == time_s * 10**9)  # noqa: B023
    ros.wait_until(lambda: bool(ticks) and ticks[-1] < 10.0)


def test_a_timer_that_was_called_too_often_is_restarted() -> None:
    """Each call puts the next one off by a period, here to more than a minute from now."""
    context = Context()
    context.init()
    node = Node('hurried', context=context)
    executor = make_executor(context)
    executor.add_node(node)
    end: Future[None] = Future()
    late = node.create_timer(10.0, lambda: end.set_exception(TimeoutError()), clock=steady())
    timer = node.create_timer(0.05, lambda: end.set_result(None), clock=steady())
    for _ in range(1500):
        timer.handle.call_timer()
    assert timer.time_until_next_call() > 60e9
    spin_until(executor, end, context)
    assert end.exception() is None
    assert not late.is_canceled() and late.time_until_next_call() < 10e9
    destroy(node)
    context.try_shutdown()


def test_timers_change(ros: RosSandbox) -> None:
    """A timer is stopped, started again, made faster, and destroys itself."""
    node = ros.observer()
    calls: list[str] = []
    slow = node.create_timer(3600.0, lambda: calls.append('slow'), clock=steady())
    slow.timer_period_ns = 1_000_000
    slow.reset()
    ros.wait_until(lambda: 'slow' in calls)
    slow.cancel()

    def once() -> None:
        node.destroy_timer(timer)
        node.create_timer(0.001, lambda: calls.append('later'), clock=steady())
        calls.append('once')

    timer = node.create_timer(0.001, once, clock=steady())
    calls.clear()
    ros.wait_until(lambda: calls.count('later') > 3)
    assert calls.count('once') == 1 and 'slow' not in calls
    slow.reset()
    ros.wait_until(lambda: 'slow' in calls)


def test_entities_made_and_destroyed_in_callbacks(ros: RosSandbox) -> None:
    """A subscription that a callback makes hears, and one that it destroys does not."""
    node, other = ros.observer(), ros.start(lambda **more: Node('other', **more))
    heard: list[str] = []
    publisher = other.create_publisher(Float64, 'number', 10)

    def first(_: Float64) -> None:
        heard.append('first')
        node.destroy_subscription(subscription)
        node.create_subscription(Float64, 'number', lambda _: heard.append('second'), 10)

    subscription = node.create_subscription(Float64, 'number', first, 10)
    other.create_timer(0.01, lambda: publisher.publish(Float64()), clock=steady())
    ros.wait_until(lambda: heard.count('second') > 3)
    assert heard.count('first') == 1


def test_parameters(ros: RosSandbox) -> None:
    """A change of a parameter is announced."""
    node, events = ros.observer(), []
    node.create_subscription(ParameterEvent, '/parameter_events', events.append, 10)
    node.declare_parameter('speed', 1.0)
    ros.wait_until(lambda: any(event.new_parameters for event in events))
    node.set_parameters([Parameter('speed', value=2.0)])
    ros.wait_until(lambda: any(event.changed_parameters for event in events))


@pytest.mark.parametrize('kind', ['events', 'single-threaded'])
def test_service_that_answers_later(ros: RosSandbox, kind: str) -> None:
    """While a coroutine has not answered, other requests are heard; its answer comes then."""
    node = ros.observer()
    executor = None
    if kind == 'single-threaded':
        context = node.context
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
    gate: Future[str] = Future()

    async def wait(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.message = await gate
        return response

    def open_it(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        gate.set_result('opened')
        return response

    group = ReentrantCallbackGroup()
    create_async_service(node, Trigger, 'wait', wait, callback_group=group)
    node.create_service(Trigger, 'open', open_it)
    clients = [
        node.create_client(Trigger, name, callback_group=group) for name in ('wait', 'open')
    ]
    answers = []
    for client in clients:
        ros.wait_until(client.service_is_ready)
        answers.append(client.call_async(Trigger.Request()))
    if executor is None:
        ros.wait_until(answers[0].done)
    else:
        executor.spin_until_future_complete(answers[0], 10.0)
        executor.shutdown()
    assert answers[0].result().message == 'opened'


def test_exception_in_a_task() -> None:
    """The process ends with a traceback, not with a crash."""
    with ros_sandbox():
        result = subprocess.run(
            [sys.executable, '-c', FAILING_TASK], capture_output=True, text=True, timeout=60.0
        )
    assert result.returncode == 1
    assert 'LookupError: a mistake' in result.stderr


def test_exception_in_a_callback(ros: RosSandbox) -> None:
    """It comes out of the executor."""
    node = ros.observer()

    def fail() -> None:
        raise LookupError('a mistake')

    node.create_timer(0.001, fail, clock=steady())
    with pytest.raises(LookupError, match='a mistake'):
        ros.wait_until(lambda: False)


def test_stop_from_another_thread() -> None:
    """Whoever sets the future from another thread ends the wait of an executor with no work."""
    stop: Future[None] = Future()
    executor = make_executor(_context())
    thread = threading.Timer(0.05, lambda: stop.set_result(None))
    thread.start()
    spin_until(executor, stop, executor.context)
    thread.join(10.0)
    executor.shutdown()
    executor.context.try_shutdown()


def test_shutdown_by_something_else() -> None:
    """The wait ends when the context is shut down."""
    context = _context()
    executor = make_executor(context)
    thread = threading.Timer(0.05, context.try_shutdown)
    thread.start()
    with pytest.raises(ExternalShutdownException):
        spin_until(executor, Future(), context)
    thread.join(10.0)


def test_older_rclpy(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there is no EventsExecutor, another one does."""
    monkeypatch.setattr('humanoid_common.executing._EventsExecutor', object)
    context = _context()
    executor = make_executor(context)
    assert isinstance(executor, SingleThreadedExecutor)
    executor.shutdown()
    context.try_shutdown()


def _context() -> Context:
    """Start ROS, for an executor without nodes."""
    context = Context()
    context.init(args=[])
    return context


def test_log_of_a_successor() -> None:
    """The log of a node is published although one of its name, with an action, was before it."""
    gc.disable()
    try:
        for _ in range(3):
            assert says_what_it_logs()
    finally:
        gc.enable()


def says_what_it_logs() -> bool:
    """Make a node with an action; return whether /rosout has its log after a collection."""
    with ros_sandbox() as ros:
        said: list[str] = []
        ros.observer().create_subscription(Log, '/rosout', lambda log: said.append(log.msg), 100)
        node = ros.start(lambda **more: Node('offering', **more))
        ActionServer(node, LookupTransform, 'look_up', lambda goal: None)
        gc.collect()
        node.get_logger().warning('here')
        ros.wait_until(lambda: 'here' in said, 10.0, 'the log')
        return True


def test_timer_that_is_always_due(ros: RosSandbox) -> None:
    """Whoever waits beside a timer that never rests still looks at the condition."""
    ticks: list[int] = []
    node = ros.observer()
    node.create_timer(1e-6, lambda: ticks.append(1), clock=Clock(clock_type=ClockType.STEADY_TIME))
    looks: list[int] = []
    ros.wait_until(lambda: looks.append(1) or (len(looks) > 20 and len(ticks) > 20), 10.0)


class CountedFuture(Future):
    """A future that counts how often it is asked whether it is done."""

    asked = 0

    def _pending(self) -> bool:
        self.asked += 1
        return bool(super()._pending())


def test_waiting_coroutine(ros: RosSandbox) -> None:
    """A coroutine is let alone while it waits, and goes on afterwards, also in those it awaits."""
    node = ros.observer()
    executor = node.executor
    future, ends = CountedFuture(), []

    async def inner() -> int:
        return int(await future)

    async def work(offset: int) -> None:
        ends.append(await inner() + offset)

    assert executor is not None
    executor.create_task(work, 1)
    node.create_timer(0.3, lambda: future.set_result(41), clock=steady())
    ros.wait_until(lambda: bool(ends), 30.0, 'the coroutine did not end')
    assert ends == [42]
    assert future.asked < 10


def test_a_node_ends_when_what_was_about_to_run_has_run(ros: RosSandbox) -> None:
    """Such as what a response has set off: it does not meet a node without its parts."""
    node = ros.observer()
    client, calls = node.create_client(Trigger, 'nothing'), []
    assert node.executor is not None
    node.executor.create_task(lambda: calls.append(client.call_async(Trigger.Request())))
    ros.end(node)
    ros.wait_until(lambda: bool(calls), 10.0, 'a call')
