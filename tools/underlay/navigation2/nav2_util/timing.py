# SPDX-License-Identifier: Apache-2.0
"""Wait in coroutines, by the clock of a node: simulated time when `use_sim_time` is on."""

from __future__ import annotations

from typing import Any, TYPE_CHECKING
from weakref import WeakSet

from rclpy.clock import Clock, ClockType
from rclpy.task import Future

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ['STEADY', 'Rate', 'clock_of', 'give_way', 'now_s', 'sleep', 'steady_clock']

STEADY = Clock(clock_type=ClockType.STEADY_TIME)
"""A clock that nobody sets, and that runs while a simulation stands; to be read."""

_of_coroutines: WeakSet[Any] = WeakSet()


def is_of_coroutine(timer: Any) -> bool:
    """
    Whether a coroutine waits for a timer, which it destroys itself.

    Parameters
    ----------
    timer
        A timer of any node.

    """
    return timer in _of_coroutines


def steady_clock() -> Clock:
    """
    Return a clock like `STEADY` for a single timer.

    rclpy's executor of events prints a warning for each timer that is created on a clock with
    seven others, and in a container all nodes share their clocks.
    """
    return Clock(clock_type=ClockType.STEADY_TIME)


def clock_of(node: Node) -> Clock:
    """
    Return, for a timer, the clock of a node if it is simulated, else a steady one.

    Parameters
    ----------
    node
        The node.

    """
    clock = node.get_clock()
    return clock if clock.ros_time_is_active else steady_clock()


def now_s(node: Node) -> float:
    """
    Return the time of a node's clock in s, for differences; it may jump back at a reset.

    Parameters
    ----------
    node
        The node; without simulated time, a steady clock counts.

    """
    clock = node.get_clock()
    return float((clock if clock.ros_time_is_active else STEADY).now().nanoseconds) * 1e-9


async def sleep(node: Node, duration_s: float) -> None:
    """
    Sleep in a coroutine; other callbacks run meanwhile.

    Parameters
    ----------
    node
        The node whose clock counts, and whose executor goes on with the coroutine.
    duration_s
        How long, in s of that clock.

    """
    done: Future[None] = Future(executor=node.executor)
    timer = node.create_timer(
        max(duration_s, 0.0), lambda: done.set_result(None), clock=clock_of(node)
    )
    _of_coroutines.add(timer)
    try:
        await done
    finally:
        node.destroy_timer(timer)


async def give_way(node: Node) -> None:
    """
    Let other callbacks that are due have their turn, whatever any clock says.

    Parameters
    ----------
    node
        The node whose executor runs them.

    """
    executor = node.executor
    if executor is not None:
        done: Future[None] = Future(executor=executor)
        executor.create_task(done.set_result, None)
        await done


class Rate:
    """
    The rhythm of a coroutine: `await rate.tick()` once each period.

    Ticks that nobody waited for are dropped. Use it as a context manager, which ends the timer.

    Parameters
    ----------
    node
        Its clock counts, and its executor goes on with the coroutine.
    rate_hz
        Ticks in a second of that clock.
    clock
        Another clock that counts.

    """

    def __init__(self, node: Node, rate_hz: float, *, clock: Clock | None = None) -> None:
        self._node = node
        self._waiting: Future[None] | None = None
        self._timer = node.create_timer(1.0 / rate_hz, self._fire, clock=clock or clock_of(node))
        _of_coroutines.add(self._timer)

    def __enter__(self) -> Rate:
        return self

    def __exit__(self, *_: Any) -> None:
        self._node.destroy_timer(self._timer)

    async def tick(self) -> None:
        """Wait for the next period."""
        self._waiting = Future(executor=self._node.executor)
        await self._waiting

    def _fire(self) -> None:
        if self._waiting is not None and not self._waiting.done():
            self._waiting.set_result(None)
