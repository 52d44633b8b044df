# SPDX-License-Identifier: Apache-2.0
"""
Executor of the programs of this environment: rclpy's EventsExecutor, made reliable.

It needs a third of the CPU time of SingleThreadedExecutor, but is experimental in Jazzy: it
rejects guard conditions, fails if a callback requests message info, ignores callback groups,
fires no timers while it waits without a timeout, may leave a timer on a simulated clock silent for
minutes, crashes when a task of its only node fails, and uses an entire CPU core while a coroutine
waits.
"""

from __future__ import annotations

import faulthandler
import inspect
from typing import Any, cast, TYPE_CHECKING

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.task import Future

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from rclpy.context import Context
    from rclpy.executors import Executor
    from rclpy.node import Node

__all__ = ['RESULT_MARGIN_S', 'make_executor', 'response_of', 'sleep', 'spin_until']

RESULT_MARGIN_S = 1e-4
"""
Time that action servers add to their result timeout: then no step of a simulated clock meets it.

rcl_action keeps a result that is exactly as old as the timeout, and sets its timer to the
remaining 0 s. Until the next step of the clock that timer is due again and again, and the events
executor dispatches it and all other timers of the clock thousands of times.
"""
_WAIT_S = 0.5
_LOOK_S = 0.1
_LOOKS_UNTIL_REPEAT = 20


class _NoNode:
    """Dummy node without entities; in its presence, task errors are raised instead of a crash."""

    executor = None
    subscriptions = timers = clients = services = guards = waitables = ()


class _Executor(_rclpy.EventsExecutor):
    """Events executor whose tasks do not busy-wait."""

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Any:
        """Create a task for a callback or a coroutine function, from any thread."""
        if not inspect.iscoroutinefunction(callback):
            return super().create_task(callback, *args, **kwargs)
        end: Future[Any] = Future(executor=self)
        self.create_task(self._resume, callback(*args, **kwargs), end)
        return end

    def _resume(self, coroutine: Coroutine[Any, Any, Any], end: Future[Any]) -> None:
        """Run a coroutine until it waits; resume it when the awaited future is done."""
        try:
            coroutine.send(None)
        except StopIteration as stop:
            end.set_result(stop.value)
            return
        except BaseException as error:
            end.set_exception(error)
            raise

        def go_on(_: object) -> None:
            self.create_task(self._resume, coroutine, end)

        awaited = _awaited(coroutine)
        if awaited is None:
            go_on(None)
        else:
            awaited.add_done_callback(go_on)


def _awaited(coroutine: Any) -> Future[Any] | None:
    """Return the future that a coroutine awaits; the yielded value is not the future in Jazzy."""
    while inspect.iscoroutine(coroutine):
        coroutine = coroutine.cr_await
    frame = getattr(coroutine, 'gi_frame', None)
    waiting = frame.f_locals.get('self') if frame is not None else None
    return waiting if isinstance(waiting, Future) else None


def make_executor(context: Context | None = None) -> Executor:
    """
    Create an events executor without nodes.

    Parameters
    ----------
    context
        The context whose shutdown wakes the executor; by default that of the process.

    """
    context = context or rclpy.get_default_context()
    faulthandler.enable()
    executor = _Executor(context)
    context.on_shutdown(executor.wake)
    executor.add_node(cast(Any, _NoNode()))
    return cast('Executor', executor)


def spin_until(executor: Executor, stop: Future[None], context: Context | None = None) -> None:
    """
    Spin an executor until a future is done or the context is shut down.

    Parameters
    ----------
    executor
        The executor, from `make_executor`.
    stop
        Ends spinning when it is done; may be set from any thread.
    context
        The context whose shutdown ends spinning; by default that of the process.

    """
    while not stop.done() and rclpy.ok(context=context):
        executor.spin_until_future_complete(stop, timeout_sec=_WAIT_S)
        _wake_timers(executor)


def _wake_timers(executor: Executor) -> None:
    """
    Restart the timers that would be late.

    If the events executor is busy when a timer on a simulated clock is due, it may dispatch it
    many times in a row. Each time puts the next call off by a period, in the end by minutes.
    """
    for node in executor.get_nodes():
        for timer in node.timers:
            left_ns = None if timer.is_canceled() else timer.time_until_next_call()
            if left_ns is not None and left_ns > timer.timer_period_ns:
                timer.reset()


async def sleep(node: Node, duration_s: float) -> None:
    """
    Suspend a coroutine, while the executor of its node goes on.

    Parameters
    ----------
    node
        The node whose executor runs the coroutine.
    duration_s
        The time in s on a steady clock, even while simulated time is paused.

    """
    end: Future[None] = Future(executor=node.executor)
    clock = Clock(clock_type=ClockType.STEADY_TIME)
    timer = node.create_timer(duration_s, lambda: end.set_result(None), clock=clock)
    try:
        await end
    finally:
        node.destroy_timer(timer)


async def response_of(node: Node, ask: Callable[[], Future[Any]]) -> Any:
    """
    Send a request to a server that is available, and return its response.

    The request is repeated every two seconds, since a response is lost if the server sends it
    before it has discovered the client; so the server must tolerate a second request.

    Parameters
    ----------
    node
        The node of the client.
    ask
        Sends the request, and returns the future of the response.

    """
    answers: list[Future[Any]] = []
    looks = 0
    while not any(answer.done() for answer in answers):
        if looks % _LOOKS_UNTIL_REPEAT == 0:
            answers.append(ask())
        looks += 1
        await sleep(node, _LOOK_S)
    return next(answer.result() for answer in answers if answer.done())
