# SPDX-License-Identifier: Apache-2.0
"""
Executor of the nodes: rclpy's EventsExecutor, with workarounds that make it reliable.

Waiting costs a third of what it costs with SingleThreadedExecutor, which rebuilds the wait set of
all subscriptions and timers before each callback. EventsExecutor is experimental in ROS 2 Jazzy:

- Guard conditions are not supported. Use `Executor.create_task` to wake it from another thread.
- Without a timeout, no timer fires while it waits. `spin_until` always sets one.
- A timer on a simulated clock may fall silent for minutes. `spin_until` restarts it.
- An exception in a task of an executor with a single node crashes the process. `make_executor`
  adds a second one, which is empty.
- Subscription callbacks receive only the message, without message info.
- A service callback that is a coroutine is not awaited. `create_async_service` awaits it.
- A waiting coroutine is polled continuously, which takes a whole CPU core. With `make_executor` it
  sleeps.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Coroutine
import inspect
from typing import Any, cast

import rclpy
from rclpy.context import Context
from rclpy.executors import Executor, ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.node import Node
from rclpy.service import Service
from rclpy.task import Future

__all__ = ['RESULT_TIMEOUT_S', 'create_async_service', 'destroy', 'make_executor', 'spin_until']

RESULT_TIMEOUT_S = 900.0001
"""
Time for which action servers keep results; no step of a simulated clock meets its end.

With rclpy's default of 900 s one does: rcl_action keeps a result that is exactly as old as the
timeout, and sets its timer to the remaining 0 s. Until the next step of the clock that timer is
due again and again, and EventsExecutor dispatches it and all other timers of the clock thousands
of times.
"""
_WAIT_S = 0.5
_EventsExecutor: Any = getattr(_rclpy, 'EventsExecutor', object)
AsyncCallback = Callable[[Any, Any], Awaitable[Any]]


class _NoNode:
    """Stand-in for a node without any entities."""

    executor = None
    subscriptions = timers = clients = services = guards = waitables = ()


class _SleepingExecutor(_EventsExecutor):
    """EventsExecutor whose tasks sleep while they wait."""

    def create_task(self, callback: Any, *args: Any, **kwargs: Any) -> Any:
        """Schedule a callback, or a coroutine function to be run to its end, from any thread."""
        if not inspect.iscoroutinefunction(callback):
            return super().create_task(callback, *args, **kwargs)
        end: Future[Any] = Future(executor=self)
        self.create_task(self._resume, callback(*args, **kwargs), end)
        return end

    def _resume(self, coroutine: Coroutine[Any, Any, Any], end: Future[Any]) -> None:
        """Run a coroutine until it waits for a future; resume it when that is done."""
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
    """Find the future that a coroutine awaits; in Jazzy, what it yields does not reveal it."""
    while inspect.iscoroutine(coroutine):
        coroutine = coroutine.cr_await
    frame = getattr(coroutine, 'gi_frame', None)
    waiting = frame.f_locals.get('self') if frame is not None else None
    return waiting if isinstance(waiting, Future) else None


def make_executor(context: Context | None = None) -> Executor:
    """
    Create the executor that all nodes of this workspace use.

    Parameters
    ----------
    context
        The ROS context; by default that of the process.

    Returns
    -------
    Executor
        An EventsExecutor, or a SingleThreadedExecutor if rclpy is too old to have one.

    """
    if _EventsExecutor is object:
        return SingleThreadedExecutor(context=context)
    context = context or rclpy.get_default_context()
    executor = cast(Executor, _SleepingExecutor(context))
    context.on_shutdown(executor.wake)
    executor.add_node(cast(Node, _NoNode()))
    return executor


def spin_until(executor: Executor, stop: Future[None], context: Context | None = None) -> None:
    """
    Spin an executor until a future is done, or the context is shut down.

    Parameters
    ----------
    executor
        The executor, which returns between two callbacks.
    stop
        Ends the spinning when it is done; it may be set from any thread.
    context
        The ROS context; by default that of the process.

    Raises
    ------
    ExternalShutdownException
        Something else shut the context down.

    """
    while not stop.done() and rclpy.ok(context=context):
        executor.spin_until_future_complete(stop, timeout_sec=_WAIT_S)
        _wake_timers(executor)
    if not stop.done():
        raise ExternalShutdownException


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


def create_async_service(
    node: Node, kind: type, name: str, callback: AsyncCallback, **options: Any
) -> Service:
    """
    Create a service whose callback is a coroutine function, whatever the executor.

    Parameters
    ----------
    node
        The node that offers the service.
    kind, name, options
        As for `Node.create_service`.
    callback
        Receives request and response, and returns the response when it is ready. An exception in
        it ends the node, as in other callbacks.

    """
    service = node.create_service(kind, name, callback, **options)
    send = service.send_response

    async def send_when_done(answer: Awaitable[Any], header: Any) -> None:
        send(await answer, header)

    def send_now_or_later(answer: Any, header: Any) -> None:
        if inspect.isawaitable(answer) and node.executor is not None:
            node.executor.create_task(send_when_done, answer, header)
        else:
            send(answer, header)

    service.send_response = send_now_or_later
    return service


def destroy(node: Node) -> None:
    """
    Destroy a node together with its action servers and clients.

    `Node.destroy_node` leaves action servers and clients to the garbage collector. Until it runs,
    the node stays visible to others; when it runs, the log of a node of the same name that was
    created meanwhile is no longer published on /rosout.

    Parameters
    ----------
    node
        The node, which no executor may spin any more.

    """
    for waitable in list(node.waitables):
        destroy_waitable = getattr(waitable, 'destroy', None)
        if destroy_waitable is not None:
            destroy_waitable()
    node.destroy_node()
