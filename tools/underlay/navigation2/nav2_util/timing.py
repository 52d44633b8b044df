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
"""A steady clock, which is independent of a simulation; for reading only."""

_of_coroutines: WeakSet[Any] = WeakSet()


def is_of_coroutine(timer: Any) -> bool:
    """
    Whether a timer belongs to a coroutine, which destroys it itself.

    Parameters
    ----------
    timer
        A timer of any node.

    """
    return timer in _of_coroutines


def steady_clock() -> Clock:
    """
    Make a clock like `STEADY` for a single timer.

    rclpy's events executor prints a warning for each timer on a clock that already has seven, and
    in a container all nodes share their clocks.
    """
    return Clock(clock_type=ClockType.STEADY_TIME)


def clock_of(node: Node) -> Clock:
    """
    Return the clock for a timer: that of the node if simulated, else a steady one.

    Parameters
    ----------
    node
        The node.

    """
    clock = node.get_clock()
    return clock if clock.ros_time_is_active else steady_clock()


def now_s(node: Node) -> float:
    """
    Read the node's clock in s, for differences; it may jump back at a reset.

    Parameters
    ----------
    node
        The node; without simulated time, a steady clock is used.

    """
    clock = node.get_clock()
    return float((clock if clock.ros_time_is_active else STEADY).now().nanoseconds) * 1e-9


async def sleep(node: Node, duration_s: float) -> None:
    """
    Sleep in a coroutine, while other callbacks run.

    Parameters
    ----------
    node
        The node, whose clock is used and whose executor resumes the coroutine.
    duration_s
        The duration, in s of that clock.

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
    Yield to other pending callbacks, independently of any clock.

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
    Rate of a loop in a coroutine: `await rate.tick()` once per period.

    Missed ticks are dropped. Use it as a context manager, which destroys the timer.

    Parameters
    ----------
    node
        The node, whose clock is used and whose executor resumes the coroutine.
    rate_hz
        The rate in Hz of that clock.
    clock
        A clock to use instead.

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
