# SPDX-License-Identifier: Apache-2.0
"""Coroutines that wait: for a time, for a rhythm, for services, and in services."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from nav2_util import sleep
from nav2_util.services import call, create_async_service, ServiceError
from nav2_util.timing import give_way, now_s, Rate, STEADY
import pytest
from rclpy.parameter import Parameter
from rclpy.task import Future
from rosgraph_msgs.msg import Clock
from std_srvs.srv import SetBool, Trigger


def steady_s() -> float:
    """Return the time in s of a clock that nobody sets."""
    return STEADY.now().nanoseconds * 1e-9


class Stand:
    """A node that runs coroutines."""

    def __init__(self, ros) -> None:
        self.ros, self.node = ros, ros.node('stand')

    def start(self, work, *arguments) -> Future:
        """Let the executor run a coroutine."""
        return self.ros.executor.create_task(work, *arguments)

    def finish(self, task: Future, timeout_s: float = 20.0):
        """Return what a coroutine returns."""
        self.ros.wait_until(task.done, timeout_s, 'the coroutine')
        return task.result()

    def error_of_call(self, client, timeout_s: float) -> str:
        """Return what a call fails with."""

        async def work() -> str:
            try:
                await call(self.node, client, Trigger.Request(), timeout_s)
            except ServiceError as error:
                return str(error)
            return ''

        return self.finish(self.start(work))


@pytest.fixture
def stand(ros):
    """Give a node whose executor runs coroutines."""
    return Stand(ros)


def test_sleep_lets_others_run(stand) -> None:
    """Two sleep at the same time, and what is shorter ends first."""
    ended = []

    async def nap(duration_s: float) -> None:
        await sleep(stand.node, duration_s)
        ended.append(duration_s)

    start_s = steady_s()
    tasks = [stand.start(nap, duration_s) for duration_s in (0.4, 0.2, 0.0)]
    for task in tasks:
        stand.finish(task)
    assert ended == [0.0, 0.2, 0.4]
    assert 0.4 <= steady_s() - start_s
    assert list(stand.node.timers) == []


def test_sleep_by_simulated_time(stand) -> None:
    """A simulation that stands lets nothing wake up; time that goes on does."""
    stand.node.set_parameters([Parameter('use_sim_time', value=True)])
    publisher = stand.node.create_publisher(Clock, '/clock', 10)

    def show(sec: int) -> None:
        publisher.publish(Clock(clock=Time(sec=sec)))
        stand.ros.wait_until(lambda: now_s(stand.node) == pytest.approx(sec))

    stand.ros.wait_until(lambda: publisher.get_subscription_count())
    show(5)
    task = stand.start(sleep, stand.node, 2.0)
    end_s = steady_s() + 0.3
    stand.ros.wait_until(lambda: steady_s() > end_s)
    show(6)
    assert not task.done()
    show(8)
    stand.finish(task)


def test_rate_drops_what_nobody_waited_for(stand) -> None:
    """Ticks that passed meanwhile do not come one after the other afterwards."""

    async def count() -> list[float]:
        with Rate(stand.node, 20.0) as rate:
            await rate.tick()
            await sleep(stand.node, 0.5)
            times_s = [steady_s()]
            for _ in range(3):
                await rate.tick()
                times_s.append(steady_s())
        return times_s

    times_s = stand.finish(stand.start(count))
    assert times_s[-1] - times_s[0] > 0.09
    assert list(stand.node.timers) == []


def test_give_way(stand) -> None:
    """Who gives way lets what was due before have its turn."""
    order = []

    async def polite() -> None:
        await give_way(stand.node)
        order.append('polite')

    first = stand.start(polite)
    second = stand.start(lambda: order.append('other'))
    stand.finish(first)
    stand.finish(second)
    assert order == ['other', 'polite']


def test_call_without_a_service(stand) -> None:
    """A service that is not there is named."""
    client = stand.node.create_client(Trigger, 'nobody')
    assert stand.error_of_call(client, 0.2) == "The service 'nobody' is not available."


def test_call_that_is_not_answered(stand) -> None:
    """A service that does not answer is named, and its answer is not waited for any more."""
    never: Future = Future(executor=stand.ros.executor)

    async def hang(_, response):
        await never
        return response

    create_async_service(stand.ros.node('mute'), Trigger, 'mute', hang)
    client = stand.node.create_client(Trigger, 'mute')
    said = stand.error_of_call(client, 0.5)
    assert said == "The service 'mute' has not answered within 0.5 s."
    assert client._pending_requests == {}
    never.set_result(None)


def test_service_that_answers_later(stand) -> None:
    """A request that takes its time keeps no other from its answer, and each gets its own."""
    server, order = stand.ros.node('server'), []

    async def answer(request, response):
        if request.data:
            await sleep(server, 0.5)
        order.append(request.data)
        response.message = f'{request.data}'
        return response

    create_async_service(server, SetBool, 'either', answer)
    client = stand.node.create_client(SetBool, 'either')
    slow = stand.start(call, stand.node, client, SetBool.Request(data=True), 10.0)
    fast = stand.start(call, stand.node, client, SetBool.Request(data=False), 10.0)
    assert stand.finish(fast).message == 'False'
    assert stand.finish(slow).message == 'True'
    assert order == [False, True]
